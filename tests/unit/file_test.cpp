#include "base/file.h"

#include "base/byte_source.h"
#include "base/error.h"
#include "unit/test_folder.h"

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <sys/resource.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace strandlab {
namespace {

using testing_tools::message_of;
using testing_tools::TestFolder;

TEST(File, WritesWholeFilesAndReadsThemBack) {
    const TestFolder folder;
    const std::string path = folder / "a.bin", bytes("a\0b\n", 4);
    write_file(path, bytes);
    EXPECT_EQ(read_file(path), bytes);
    write_file(path, "");
    EXPECT_EQ(read_file(path), "");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(File, NamesPathAndReasonWhenReadingFails) {
    const TestFolder folder;
    EXPECT_EQ(message_of([&] { read_file(folder / "none"); }),
              folder / "none" + ": cannot read: No such file or directory");
    EXPECT_NE(message_of([&] { read_file(folder.path()); }).find("Is a directory"), std::string::npos);
}

TEST(File, LeavesNothingBehindWithoutCommit) {
    const TestFolder folder;
    const std::string path = folder / "a.txt";
    write_file(path, "old");
    { FileWriter(path).write("new"); }
    EXPECT_EQ(read_file(path), "old");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(File, NamesPathAndReasonWhenWritingFails) {
    const TestFolder folder;
    EXPECT_EQ(message_of([&] { write_file(folder / "none/a", "x"); }),
              folder / "none/a" + ": cannot write: No such file or directory");
    EXPECT_NE(message_of([&] { write_file(folder.path(), "x"); }).find("Is a directory"), std::string::npos);
}

TEST(File, WritesDevicesDirectlyAndReportsAFullDisk) {
    if (::access("/dev/full", W_OK) != 0) GTEST_SKIP() << "no /dev/full here";
    EXPECT_EQ(message_of([] { write_file("/dev/full", "x"); }),
              "/dev/full: cannot write: No space left on device");
    struct stat status;
    ASSERT_EQ(::stat("/dev/full", &status), 0);
    EXPECT_TRUE(S_ISCHR(status.st_mode));
}

TEST(File, RemovesTheTemporaryWhenTheDiskIsFull) {
    const TestFolder folder;
    const std::string path = folder / "a.txt";
    write_file(path, "old");
    const auto before = std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit;
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
    const rlimit tiny{4096, limit.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tiny), 0);
    const std::string message = message_of([&] { write_file(path, std::string(10000, 'x')); });
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, before);
    EXPECT_NE(message.find(path + ": cannot write: "), std::string::npos) << message;
    EXPECT_EQ(read_file(path), "old");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(File, FollowsLinksAndKeepsTheMode) {
    const TestFolder folder;
    write_file(folder / "real", "old");
    ASSERT_EQ(::chmod((folder / "real").c_str(), 0640), 0);
    ASSERT_EQ(::symlink("real", (folder / "link").c_str()), 0);
    write_file(folder / "link", "new");
    EXPECT_EQ(read_file(folder / "real"), "new");
    struct stat status;
    ASSERT_EQ(::lstat((folder / "link").c_str(), &status), 0);
    EXPECT_TRUE(S_ISLNK(status.st_mode));
    ASSERT_EQ(::stat((folder / "real").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST(File, AppendsWholeLinesFromManyThreads) {
    const TestFolder folder;
    const std::string path = folder / "rows";
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&, t] {
            for (int i = 0; i < 50; ++i)
                append_line(path, std::string(300, static_cast<char>('a' + t)), "header");
        });
    for (std::thread& thread : threads) thread.join();
    std::ifstream file(path);
    std::string header;
    std::getline(file, header);
    EXPECT_EQ(header, "header") << "once, whoever comes first";
    size_t lines = 0;
    for (std::string line; std::getline(file, line); ++lines) {
        ASSERT_EQ(line.size(), 300u);
        ASSERT_EQ(line.find_first_not_of(line[0]), std::string::npos);
    }
    EXPECT_EQ(lines, 200u);
}

TEST(File, CompletesALastLineThatWasCutOff) {
    const TestFolder folder;
    write_file(folder / "rows", "half");
    append_line(folder / "rows", "next");
    EXPECT_EQ(read_file(folder / "rows"), "half\nnext\n");
    EXPECT_NE(message_of([&] { append_line(folder / "none/rows", "x"); }).find("cannot append"),
              std::string::npos);
}

TEST(File, CutsOffATornLastLine) {
    const TestFolder folder;
    const std::string path = folder / "rows", long_line(10'000, 'x');
    const auto repaired = [&](const std::string& bytes) {
        write_file(path, bytes);
        const bool dropped = drop_torn_line(path, [](std::string_view line) { return line == "whole"; });
        return std::pair(dropped, read_file(path));
    };
    EXPECT_EQ(repaired(""), std::pair(false, std::string()));
    EXPECT_EQ(repaired("a\nb\n"), std::pair(false, std::string("a\nb\n")));
    EXPECT_EQ(repaired("a\nwhole"), std::pair(false, std::string("a\nwhole")));
    EXPECT_EQ(repaired("a\nwhol"), std::pair(true, std::string("a\n")));
    EXPECT_EQ(repaired("torn"), std::pair(true, std::string()));
    EXPECT_EQ(repaired(long_line + "\n" + long_line), std::pair(true, long_line + "\n"));
    EXPECT_FALSE(drop_torn_line(folder / "none", [](std::string_view) { return false; }));
    EXPECT_FALSE(drop_torn_line("/dev/null", [](std::string_view) { return false; }));
}

TEST(ByteSource, ReadsPipesAndRefusesToReadBeyondTheEnd) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    ASSERT_EQ(::write(ends[1], "abcdef", 6), 6);
    ::close(ends[1]);
    const ByteSource source = ByteSource::from_file("/dev/fd/" + std::to_string(ends[0]));
    ::close(ends[0]);
    EXPECT_EQ(source.size(), 6u);
    EXPECT_EQ(source.value<char>(5, "letter"), 'f');
    EXPECT_NE(message_of([&] {
                  source.array<uint32_t>(4, ~uint64_t(0), "words");
              }).find("words: 18446744073709551615 x 4 bytes at offset 4 do not fit into the file's 6 bytes"),
              std::string::npos);
    EXPECT_NE(message_of([&] { source.value<char>(7, "letter"); }).find("offset 7"), std::string::npos);
}

TEST(ByteSource, ReadsLongFilesInParallel) {
    const TestFolder folder;
    std::string bytes(size_t(9) << 20, '\0');
    for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 2654435761u >> 13);
    write_file(folder / "long", bytes);
    EXPECT_TRUE(read_file(folder / "long") == bytes);
}

}  // namespace
}  // namespace strandlab
