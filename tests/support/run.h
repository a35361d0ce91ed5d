// SPDX-License-Identifier: MIT
//
// Runs the built `lodestar` as a user would, and tells what came of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lodestar::testing {

struct RunResult {
    int status = -1;    ///< exit status; -signal if a signal ended it
    std::string out;    ///< standard output
    std::string err;    ///< standard error
    double seconds = 0; ///< wall time
    bool timedOut = false;

    /// Lines of standard error that are not warnings.
    [[nodiscard]] std::vector<std::string> errorLines() const;
};

/// @param arguments without the program's name  @param environment extra NAME=VALUE
/// @param timeout seconds after which it is killed
[[nodiscard]] RunResult runLodestar(const std::vector<std::string>& arguments,
                                    const std::vector<std::string>& environment = {},
                                    double timeout = 60.0);

/// A fresh folder for a test's outputs, removed at the end.
class TemporaryFolder {
public:
    TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder();
    [[nodiscard]] std::filesystem::path path() const { return path_; }
    [[nodiscard]] std::string file(const std::string& name) const { return path_ + "/" + name; }

private:
    std::string path_;
};

} // namespace lodestar::testing
