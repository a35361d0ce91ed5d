// SPDX-License-Identifier: MIT
#include "io/file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace lodestar::io {
namespace {

/// O_NONBLOCK: opening a FIFO without a writer returns at once instead of waiting.
constexpr int kReadFlags = O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY;
/// Folders are only passed through; O_PATH asks for no right to list them.
constexpr int kFolderFlags = O_PATH | O_DIRECTORY | O_CLOEXEC;

class Descriptor {
public:
    explicit Descriptor(int descriptor = -1) : descriptor_(descriptor) {}
    Descriptor(Descriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }
    ~Descriptor() { close(); }

    [[nodiscard]] int get() const { return descriptor_; }
    [[nodiscard]] bool open() const { return descriptor_ >= 0; }
    /// Closes now; false where the system reports a late write error.
    bool close() {
        const int descriptor = std::exchange(descriptor_, -1);
        return descriptor < 0 || ::close(descriptor) == 0;
    }

private:
    int descriptor_;
};

std::string systemMessage(int code) {
    return std::generic_category().message(code);
}

/// Reads an opened file whole, if it is a regular one of at most maxBytes.
core::Result<Bytes> readOpened(int descriptor, std::size_t maxBytes) {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0) {
        return core::refused(systemMessage(errno));
    }
    if (S_ISDIR(status.st_mode)) {
        return core::refused("is a folder, not a file");
    }
    if (!S_ISREG(status.st_mode)) {
        return core::refused("is not a regular file (devices, pipes and sockets are not read)");
    }
    if (static_cast<std::uintmax_t>(status.st_size) > maxBytes) {
        return core::refused("is " + std::to_string(status.st_size) + " bytes long, the limit is " +
                             std::to_string(maxBytes));
    }
    Bytes bytes(static_cast<std::size_t>(status.st_size));
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count = ::read(descriptor, bytes.data() + done, bytes.size() - done);
        if (count < 0) {
            if (errno == EINTR) {
                continue;
            }
            return core::refused(systemMessage(errno));
        }
        if (count == 0) {
            break; // it shrank while being read
        }
        done += static_cast<std::size_t>(count);
    }
    bytes.resize(done);
    return bytes;
}

int hexDigit(char c) {
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    const char lower = static_cast<char>(c | 0x20);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

std::string percentDecodedOnce(const std::string& text) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && hexDigit(text[i + 1]) >= 0 &&
            hexDigit(text[i + 2]) >= 0) {
            decoded += static_cast<char>(hexDigit(text[i + 1]) * 16 + hexDigit(text[i + 2]));
            i += 2;
        } else {
            decoded += text[i];
        }
    }
    return decoded;
}

/// The path's names with "." and ".." worked out; false where it climbs out or is
/// absolute. Backslashes count as separators: no honest name holds "..\".
bool staysBelow(const std::string& path, std::vector<std::string>& names) {
    names.clear();
    if (path.empty() || path.front() == '/' || path.front() == '\\' ||
        path.find('\0') != std::string::npos) {
        return false;
    }
    int depth = 0;
    std::size_t begin = 0;
    while (begin <= path.size()) {
        const std::size_t end = std::min(path.find_first_of("/\\", begin), path.size());
        const std::string name = path.substr(begin, end - begin);
        if (name == "..") {
            if (--depth < 0) {
                return false;
            }
        } else if (!name.empty() && name != ".") {
            ++depth;
        }
        begin = end + 1;
    }
    for (std::size_t from = 0; from <= path.size();) {
        const std::size_t end = std::min(path.find('/', from), path.size());
        const std::string name = path.substr(from, end - from);
        if (name == ".." && !names.empty()) {
            names.pop_back();
        } else if (!name.empty() && name != "." && name != "..") {
            names.push_back(name);
        }
        from = end + 1;
    }
    return !names.empty();
}

/// Opens below a folder where the kernel lacks openat2: name by name, no link followed.
Descriptor openByNames(int folder, const std::vector<std::string>& names) {
    Descriptor current;
    int at = folder;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const bool last = i + 1 == names.size();
        Descriptor next(
            ::openat(at, names[i].c_str(), (last ? kReadFlags : kFolderFlags) | O_NOFOLLOW));
        if (!next.open()) {
            return Descriptor();
        }
        current = std::move(next);
        at = current.get();
    }
    return current;
}

Descriptor openBelow(int folder, const std::string& path, const std::vector<std::string>& names) {
    open_how how{};
    how.flags = static_cast<decltype(how.flags)>(kReadFlags);
    how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
    for (int attempt = 0; attempt < 8; ++attempt) {
        const long descriptor = ::syscall(SYS_openat2, folder, path.c_str(), &how, sizeof how);
        if (descriptor >= 0) {
            return Descriptor(static_cast<int>(descriptor));
        }
        // EAGAIN: a rename ran through the path meanwhile. EPERM comes from sandboxes that filter
        // calls they do not know; the walk by names is as strict.
        if (errno == ENOSYS || errno == EPERM) {
            return openByNames(folder, names);
        }
        if (errno != EAGAIN && errno != EINTR) {
            break;
        }
    }
    return Descriptor();
}

/// A name for a temporary beside the target that no other writer has.
std::filesystem::path temporaryBeside(const std::filesystem::path& path) {
    static std::atomic<unsigned> serial{0};
    std::filesystem::path temporary = path;
    temporary += ".tmp-" + std::to_string(::getpid()) + "-" + std::to_string(serial++);
    return temporary;
}

core::Error outputFailed(const std::filesystem::path& path, std::string what) {
    return {core::ErrorCode::OutputFailed, std::move(what), path.string(), {}};
}

/// Writes all bytes and flushes them to the disk; the error number or 0.
int writeAll(Descriptor& file, const unsigned char* bytes, std::size_t size) {
    std::size_t done = 0;
    while (done < size) {
        const ssize_t count = ::write(file.get(), bytes + done, size - done);
        if (count < 0) {
            if (errno == EINTR) {
                continue;
            }
            return errno;
        }
        done += static_cast<std::size_t>(count);
    }
    if (::fsync(file.get()) != 0 && errno != EINVAL) {
        return errno;
    }
    return file.close() ? 0 : errno;
}

} // namespace

struct AssetRoot::Folder {
    Descriptor descriptor;
};

core::Result<AssetRoot> AssetRoot::open(const std::filesystem::path& folder) {
    Descriptor descriptor(::open(folder.empty() ? "." : folder.c_str(), kFolderFlags));
    if (!descriptor.open()) {
        return core::inFile(
            core::refused("the asset folder cannot be opened: " + systemMessage(errno)),
            folder.string());
    }
    AssetRoot root;
    auto opened = std::make_shared<Folder>();
    opened->descriptor = std::move(descriptor);
    root.folder_ = std::move(opened);
    return root;
}

core::Result<Bytes> AssetRoot::read(const std::string& relativePath, std::size_t maxBytes) const {
    LODESTAR_EXPECT(folder_ != nullptr, "an AssetRoot is made by open");
    std::vector<std::string> names;
    // Also what the text would say once or twice percent-decoded: nobody who has an honest file of
    // that name writes it so, and whoever decodes later must not be the one who climbs out.
    std::string decoded = relativePath;
    bool below = true;
    for (int i = 0; i < 3 && below; ++i) {
        below = staysBelow(decoded, names);
        decoded = percentDecodedOnce(decoded);
    }
    if (!below || !staysBelow(relativePath, names)) {
        return core::refused("'" + relativePath + "' leads out of the asset folder");
    }
    const Descriptor file = openBelow(folder_->descriptor.get(), relativePath, names);
    if (!file.open()) {
        const int code = errno;
        const bool outside = code == EXDEV || code == ELOOP;
        return core::refused("cannot read '" + relativePath + "': " +
                             (outside ? "it leads out of the asset folder" : systemMessage(code)));
    }
    core::Result<Bytes> bytes = readOpened(file.get(), maxBytes);
    if (!bytes) {
        return core::refused("'" + relativePath + "' " + bytes.error().what);
    }
    return bytes;
}

core::Result<Bytes> readFile(const std::filesystem::path& path, std::size_t maxBytes) {
    const Descriptor file(::open(path.c_str(), kReadFlags));
    if (!file.open()) {
        return core::inFile(core::refused("cannot be opened: " + systemMessage(errno)),
                            path.string());
    }
    core::Result<Bytes> bytes = readOpened(file.get(), maxBytes);
    if (!bytes) {
        return core::inFile(bytes.error(), path.string());
    }
    return bytes;
}

core::Result<void> writeFile(const std::filesystem::path& path, const void* data,
                             std::size_t size) {
    struct stat status {};
    // Renaming over a device or a pipe would replace it by a file.
    if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
        return outputFailed(path, "cannot be written: it exists and is not a regular file");
    }
    // A link keeps pointing at the file it names.
    std::error_code code;
    const std::filesystem::path resolved = std::filesystem::canonical(path, code);
    const std::filesystem::path target = code ? path : resolved;
    const std::filesystem::path temporary = temporaryBeside(target);
    Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (!file.open()) {
        return outputFailed(path, "cannot be written: " + systemMessage(errno));
    }
    int failure = writeAll(file, static_cast<const unsigned char*>(data), size);
    if (failure == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) {
        failure = errno;
    }
    if (failure != 0) {
        file.close();
        ::unlink(temporary.c_str());
        return outputFailed(path, "cannot be written: " + systemMessage(failure));
    }
    // The rename itself is durable once the folder is flushed; where that is refused the file is
    // whole all the same.
    const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
    const Descriptor parent(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (parent.open()) {
        static_cast<void>(::fsync(parent.get()));
    }
    return {};
}

} // namespace lodestar::io
