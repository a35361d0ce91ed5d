// SPDX-License-Identifier: MIT
#include <csignal>

#include <sys/resource.h>
#include <sys/stat.h>

#include "io/file.h"
#include "unit/io/io_support.h"

namespace lodestar {
namespace {

using testing::StopWatch;
using testing::TemporaryFolder;

std::size_t filesIn(const std::filesystem::path& folder) {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder),
                                                  std::filesystem::directory_iterator()));
}

class AssetRootTest : public ::testing::Test {
protected:
    AssetRootTest() {
        folder_.write("secret.bin", "secret");
        folder_.write("root/a.bin", "abc");
        folder_.write("root/sub/b c.bin", "defg");
        std::filesystem::create_symlink(folder_ / "secret.bin", folder_ / "root/link");
        std::filesystem::create_symlink("..", folder_ / "root/up");
        std::filesystem::create_symlink("/", folder_ / "root/top");
        std::filesystem::create_symlink("loop", folder_ / "root/loop");
        ::mkfifo((folder_ / "root/fifo").c_str(), 0600);
    }
    TemporaryFolder folder_;
};

TEST_F(AssetRootTest, ReadsWhatLiesBelow) {
    const core::Result<io::AssetRoot> root = io::AssetRoot::open(folder_ / "root");
    ASSERT_TRUE(root.ok());
    for (const char* path : {"a.bin", "./a.bin", "sub/../a.bin", "sub//../a.bin"}) {
        const core::Result<io::Bytes> bytes = root->read(path);
        ASSERT_TRUE(bytes.ok()) << path << ": " << bytes.error().message();
        EXPECT_EQ(std::string(bytes->begin(), bytes->end()), "abc") << path;
    }
    ASSERT_TRUE(root->read("sub/b c.bin").ok());
    EXPECT_EQ(root->read("sub/b c.bin")->size(), 4U);
    EXPECT_TRUE(root->read("a.bin", 3).ok());
    EXPECT_FALSE(root->read("a.bin", 2).ok());
}

TEST_F(AssetRootTest, RefusesEveryWayOut) {
    const core::Result<io::AssetRoot> root = io::AssetRoot::open(folder_ / "root");
    ASSERT_TRUE(root.ok());
    const std::string absolute = (folder_ / "secret.bin").string();
    const std::vector<std::string> paths{"../secret.bin",
                                         "./../secret.bin",
                                         "sub/../../secret.bin",
                                         "sub/../../root/../secret.bin",
                                         "..",
                                         ".",
                                         "",
                                         "/",
                                         absolute,
                                         "/" + absolute,
                                         "%2e%2e/secret.bin",
                                         "%2e%2e%2fsecret.bin",
                                         "..%2Fsecret.bin",
                                         ".%2e/secret.bin",
                                         "%252e%252e/secret.bin",
                                         "%2fetc%2fpasswd",
                                         "..\\secret.bin",
                                         "sub\\..\\..\\secret.bin",
                                         "link",
                                         "up/secret.bin",
                                         "top" + absolute,
                                         "loop",
                                         "fifo",
                                         "sub",
                                         "missing",
                                         std::string("a.bin\0.png", 10),
                                         "file://" + absolute,
                                         std::string(5000, 'a')};
    EXPECT_GE(paths.size(), 15U);
    for (const std::string& path : paths) {
        const StopWatch watch;
        const core::Result<io::Bytes> bytes = root->read(path);
        EXPECT_FALSE(bytes.ok()) << path;
        EXPECT_LT(watch.seconds(), testing::kMaxSeconds) << path;
        if (!bytes) {
            EXPECT_EQ(bytes.error().code, core::ErrorCode::InputRefused);
            EXPECT_FALSE(bytes.error().what.empty());
        }
    }
}

TEST_F(AssetRootTest, MissingFolderIsRefused) {
    const core::Result<io::AssetRoot> root = io::AssetRoot::open(folder_ / "nowhere");
    ASSERT_FALSE(root.ok());
    testing::expectOneLine(root.error(), (folder_ / "nowhere").string());
}

TEST_F(AssetRootTest, ReadFileTakesRegularFilesOnly) {
    EXPECT_TRUE(io::readFile(folder_ / "root/link").ok()) << "the user may name a link";
    for (const std::filesystem::path& path :
         {folder_ / "root/fifo", folder_ / "root", folder_ / "none",
          std::filesystem::path("/dev/zero"), std::filesystem::path("/dev/null"),
          std::filesystem::path("")}) {
        const StopWatch watch;
        const core::Result<io::Bytes> bytes = io::readFile(path);
        ASSERT_FALSE(bytes.ok()) << path;
        EXPECT_LT(watch.seconds(), testing::kMaxSeconds) << path;
        EXPECT_EQ(bytes.error().code, core::ErrorCode::InputRefused);
    }
    EXPECT_FALSE(io::readFile(folder_ / "secret.bin", 5).ok());
}

TEST(WriteFile, ReplacesWholeAndKeepsLinks) {
    const TemporaryFolder folder;
    folder.write("out", "old");
    std::filesystem::create_symlink("out", folder / "link");
    ASSERT_TRUE(io::writeFile(folder / "link", "newer", 5).ok());
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(io::readFile(folder / "out")->size(), 5U);
    EXPECT_EQ(filesIn(folder.path()), 2U);
}

TEST(WriteFile, RefusesWhatIsNoFile) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "dir");
    for (const std::filesystem::path& path :
         {folder / "dir", folder / "none/out", std::filesystem::path("/dev/full"),
          std::filesystem::path("")}) {
        const core::Result<void> written = io::writeFile(path, "abc", 3);
        ASSERT_FALSE(written.ok()) << path;
        EXPECT_EQ(written.error().code, core::ErrorCode::OutputFailed);
    }
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(WriteFile, FullDiskLeavesTheOldFile) {
    const TemporaryFolder folder;
    folder.write("out", "old");
    // A limit on file size fails the write with EFBIG where a full disk gives ENOSPC.
    const auto before = std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
    const rlimit tight{4096, limit.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tight), 0);
    const std::string data(10000, 'x');
    const core::Result<void> written = io::writeFile(folder / "out", data.data(), data.size());
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
    std::signal(SIGXFSZ, before);
    ASSERT_FALSE(written.ok());
    EXPECT_EQ(written.error().code, core::ErrorCode::OutputFailed);
    EXPECT_EQ(io::readFile(folder / "out")->size(), 3U);
    EXPECT_EQ(filesIn(folder.path()), 1U);
}

} // namespace
} // namespace lodestar
