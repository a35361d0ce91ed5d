// SPDX-License-Identifier: MIT
//
// A real X server in memory, with a window manager, for tests of windows driven by synthetic input.
#pragma once

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lodestar::testing {

/// Starts a program, silent but for one descriptor it may inherit.
inline pid_t start(std::vector<std::string> words) {
    const pid_t child = fork();
    if (child == 0) {
        const int null = open("/dev/null", O_RDWR);
        dup2(null, 1);
        dup2(null, 2);
        std::vector<char*> argv;
        for (std::string& word : words) {
            argv.push_back(word.data());
        }
        argv.push_back(nullptr);
        execvp(argv[0], argv.data());
        _exit(127);
    }
    return child;
}

inline void end(pid_t child) {
    if (child > 0) {
        kill(child, SIGTERM);
        waitpid(child, nullptr, 0);
    }
}

/// What a shell command prints.
inline std::string output(const std::string& command) {
    std::string text;
    if (FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r")) {
        char part[256];
        while (std::fgets(part, sizeof part, pipe) != nullptr) {
            text += part;
        }
        pclose(pipe);
    }
    return text;
}

inline bool soon(const std::function<bool()>& holds, double seconds = 120.0) {
    const auto start = std::chrono::steady_clock::now();
    while (!holds()) {
        if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() >
            seconds) {
            return false;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return true;
}

/// A virtual X server with a window manager, for the life of the object.
class VirtualDisplay {
public:
    /// @param size WIDTHxHEIGHT of the screen
    explicit VirtualDisplay(const std::string& size = "1440x900") {
        int ends[2] = {-1, -1};
        if (pipe(ends) != 0) {
            return;
        }
        server_ = start({"Xvfb", "-displayfd", std::to_string(ends[1]), "-screen", "0",
                         size + "x24", "-nolisten", "tcp"});
        close(ends[1]);
        char number[16] = {};
        if (read(ends[0], number, sizeof number - 1) > 0) {
            name_ = std::string(1, ':').append(std::to_string(std::atoi(number)));
            setenv("DISPLAY", name_.c_str(), 1);
            manager_ = start({"openbox"});
        }
        close(ends[0]);
    }
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;
    ~VirtualDisplay() {
        end(manager_);
        end(server_);
        unsetenv("DISPLAY");
    }
    [[nodiscard]] const std::string& name() const { return name_; }
    /// Waits for both: a window that is mapped while the manager takes over may be shown by
    /// neither.
    [[nodiscard]] bool isReady() const {
        return !name_.empty() && soon([] {
            return output("xdotool get_num_desktops && echo ready").find("ready") !=
                   std::string::npos;
        });
    }

private:
    pid_t server_ = -1;
    pid_t manager_ = -1;
    std::string name_;
};

/// Which programs such a test lacks, as a sentence; empty where all are there or
/// LODESTAR_REQUIRE_GL=1 asks for a failure instead of a skip.
inline std::string missingPrograms() {
    const char* required = std::getenv("LODESTAR_REQUIRE_GL");
    if (required != nullptr && std::string(required) == "1") {
        return {};
    }
    for (const char* program : {"Xvfb", "xprop", "xdotool", "openbox", "import"}) {
        if (output(std::string("command -v ") + program).empty()) {
            return std::string("needs Xvfb, xprop, openbox, xdotool and ImageMagick: no ") +
                   program;
        }
    }
    return {};
}

} // namespace lodestar::testing
