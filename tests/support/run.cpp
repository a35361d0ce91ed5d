// SPDX-License-Identifier: MIT
#include "support/run.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lodestar::testing {
namespace {

std::string contents(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

[[noreturn]] void becomeLodestar(const std::vector<std::string>& arguments,
                                 const std::vector<std::string>& environment,
                                 const std::string& out, const std::string& err) {
    const auto redirect = [](const std::string& path, int descriptor) {
        const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        dup2(file, descriptor);
        close(file);
    };
    redirect(out, 1);
    redirect(err, 2);
    for (const std::string& variable : environment) {
        putenv(const_cast<char*>(variable.c_str()));
    }
    std::vector<char*> argv = {const_cast<char*>(LODESTAR_EXECUTABLE)};
    for (const std::string& argument : arguments) {
        argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    execv(argv[0], argv.data());
    _exit(127);
}

} // namespace

std::vector<std::string> RunResult::errorLines() const {
    std::vector<std::string> lines;
    std::istringstream stream(err);
    for (std::string line; std::getline(stream, line);) {
        if (line.rfind("lodestar: warning: ", 0) != 0) {
            lines.push_back(line);
        }
    }
    return lines;
}

RunResult runLodestar(const std::vector<std::string>& arguments,
                      const std::vector<std::string>& environment, double timeout) {
    const TemporaryFolder folder;
    const std::string out = folder.file("out");
    const std::string err = folder.file("err");
    const auto start = std::chrono::steady_clock::now();
    const auto elapsed = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const pid_t child = fork();
    if (child == 0) {
        becomeLodestar(arguments, environment, out, err);
    }
    RunResult result;
    int state = 0;
    while (waitpid(child, &state, WNOHANG) == 0) {
        if (elapsed() > timeout) {
            kill(child, SIGKILL);
            waitpid(child, &state, 0);
            result.timedOut = true;
            break;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    result.seconds = elapsed();
    result.status = WIFEXITED(state) ? WEXITSTATUS(state) : -WTERMSIG(state);
    result.out = contents(out);
    result.err = contents(err);
    return result;
}

TemporaryFolder::TemporaryFolder() {
    std::string pattern =
        (std::filesystem::temp_directory_path() / "lodestar-test-XXXXXX").string();
    if (const char* made = mkdtemp(pattern.data())) {
        path_ = made;
    }
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

} // namespace lodestar::testing
