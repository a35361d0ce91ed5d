// SPDX-License-Identifier: MIT
//
// Reading files below an asset root and writing them whole. The only code that opens a file for
// reading; every path from inside a document goes through AssetRoot.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"

namespace lodestar::io {

using Bytes = std::vector<unsigned char>;

/// Largest file that is read.
inline constexpr std::size_t kMaxFileBytes = std::size_t{512} << 20;

/// A folder that reads may not leave: not by "..", absolute paths, percent-encoding or links.
class AssetRoot {
public:
    /// @errors InputRefused if the folder cannot be opened
    [[nodiscard]] static core::Result<AssetRoot> open(const std::filesystem::path& folder);

    /// Reads a regular file by a path relative to the root. Never blocks on a FIFO or device.
    /// @errors InputRefused naming the path: missing, outside the root, not a regular file, too
    /// large
    [[nodiscard]] core::Result<Bytes> read(const std::string& relativePath,
                                           std::size_t maxBytes = kMaxFileBytes) const;

private:
    struct Folder;
    std::shared_ptr<const Folder> folder_;
};

/// Reads a file that the user named on the command line (any path).
[[nodiscard]] core::Result<Bytes> readFile(const std::filesystem::path& path,
                                           std::size_t maxBytes = kMaxFileBytes);

/// Writes a file whole: to a temporary beside it, flushed, then renamed over. On failure the old
/// file is untouched and no temporary stays. @errors OutputFailed
[[nodiscard]] core::Result<void> writeFile(const std::filesystem::path& path, const void* data,
                                           std::size_t size);

} // namespace lodestar::io
