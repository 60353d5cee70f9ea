#include "base/cache.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

namespace strandlab {
namespace {

namespace fs = std::filesystem;

std::vector<std::byte> bytes_of(std::string_view text) {
    std::vector<std::byte> bytes;
    for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
    return bytes;
}

class CacheTest : public testing::Test {
  protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "strandlab-cache-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        root_ = pattern;
        folder_ = root_ / "cache";
    }
    void TearDown() override {
        std::error_code ignored;
        fs::permissions(root_, fs::perms::owner_all, ignored);
        fs::remove_all(root_, ignored);
    }
    size_t files() const {
        return static_cast<size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

    fs::path root_, folder_;
};

TEST_F(CacheTest, ReturnsWhatWasWritten) {
    const Cache cache(folder_);
    EXPECT_FALSE(cache.read("a"));
    cache.write("a", bytes_of("first"));
    cache.write("b", {});
    EXPECT_EQ(cache.read("a"), bytes_of("first"));
    EXPECT_EQ(cache.read("b"), bytes_of(""));
    EXPECT_FALSE(cache.read("c"));
    cache.write("a", bytes_of("second"));
    EXPECT_EQ(cache.read("a"), bytes_of("second"));
    EXPECT_EQ(files(), 2u) << "nothing unfinished is left behind";
}

TEST_F(CacheTest, EveryDamagedByteIsNoticed) {
    const Cache cache(folder_);
    const fs::path file = cache.file_of("key");
    cache.write("key", bytes_of("payload of some length"));
    const auto size = fs::file_size(file);
    for (uintmax_t i = 0; i < size; ++i) {
        cache.write("key", bytes_of("payload of some length"));
        {
            std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
            stream.seekg(static_cast<std::streamoff>(i));
            const char damaged = static_cast<char>(stream.get() ^ 0x40);
            stream.seekp(static_cast<std::streamoff>(i));
            stream.put(damaged);
        }
        EXPECT_FALSE(cache.read("key")) << "byte " << i;
        EXPECT_FALSE(fs::exists(file)) << "byte " << i;
    }
}

TEST_F(CacheTest, EveryTruncationAndExtraBytesAreNoticed) {
    const Cache cache(folder_);
    const fs::path file = cache.file_of("key");
    cache.write("key", bytes_of("payload"));
    const auto size = fs::file_size(file);
    for (uintmax_t length = 0; length < size; ++length) {
        cache.write("key", bytes_of("payload"));
        fs::resize_file(file, length);
        EXPECT_FALSE(cache.read("key")) << "length " << length;
    }
    cache.write("key", bytes_of("payload"));
    fs::resize_file(file, size + 1);
    EXPECT_FALSE(cache.read("key"));
    cache.write("key", bytes_of("payload"));
    EXPECT_TRUE(cache.read("key"));
}

TEST_F(CacheTest, AnEntryUnderTheNameOfAnotherKeyIsAbsent) {
    const Cache cache(folder_);
    cache.write("key1", bytes_of("payload"));
    fs::copy_file(cache.file_of("key1"), cache.file_of("key2"));
    EXPECT_FALSE(cache.read("key2"));
    EXPECT_TRUE(cache.read("key1"));
}

TEST_F(CacheTest, WhatWasNotUsedForLongestGoesFirst) {
    const auto payload = std::vector<std::byte>(1000);
    const Cache cache(folder_, 3500);  // three entries with their headers
    const auto now = fs::file_time_type::clock::now();
    int hours = 10;
    for (const char* key : {"a", "b", "c"}) {
        cache.write(key, payload);
        fs::last_write_time(cache.file_of(key), now - std::chrono::hours(hours--));
    }
    EXPECT_TRUE(cache.read("a"));  // used again: now b is the oldest
    std::ofstream(folder_ / "not ours.txt") << std::string(5000, 'x');
    cache.write("d", payload);
    EXPECT_TRUE(fs::exists(cache.file_of("a")));
    EXPECT_FALSE(fs::exists(cache.file_of("b")));
    EXPECT_TRUE(fs::exists(cache.file_of("c")));
    EXPECT_TRUE(fs::exists(cache.file_of("d")));
    EXPECT_TRUE(fs::exists(folder_ / "not ours.txt"));

    cache.write("too large", std::vector<std::byte>(4000));
    EXPECT_FALSE(cache.read("too large"));
    EXPECT_TRUE(cache.read("d"));
}

TEST_F(CacheTest, RemovesWhatKilledProcessesLeft) {
    const Cache cache(folder_);
    cache.write("a", bytes_of("x"));
    const fs::path old = folder_ / "old.part", fresh = folder_ / "fresh.part";
    std::ofstream(old) << "x";
    std::ofstream(fresh) << "x";
    fs::last_write_time(old, fs::file_time_type::clock::now() - std::chrono::hours(2));
    cache.write("b", bytes_of("x"));
    EXPECT_FALSE(fs::exists(old));
    EXPECT_TRUE(fs::exists(fresh));
}

TEST_F(CacheTest, FoldersThatCannotBeUsedAreEmptyCaches) {
    std::ofstream(root_ / "file") << "in the way";
    const Cache blocked(root_ / "file" / "cache");
    blocked.write("a", bytes_of("x"));
    EXPECT_FALSE(blocked.read("a"));

    const Cache nowhere("");
    nowhere.write("a", bytes_of("x"));
    EXPECT_FALSE(nowhere.read("a"));

    const Cache cache(folder_);
    fs::create_directories(cache.file_of("a"));  // a folder where the entry belongs
    cache.write("a", bytes_of("x"));
    EXPECT_FALSE(cache.read("a"));
    EXPECT_EQ(files(), 1u);

    if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere: not tried with a read-only folder";
    fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
    cache.write("b", bytes_of("x"));
    EXPECT_FALSE(cache.read("b"));
    fs::permissions(folder_, fs::perms::owner_all);
}

TEST_F(CacheTest, ConcurrentWritersLeaveOneWholeEntry) {
    std::vector<std::thread> threads;
    std::atomic<int> damaged{0};
    for (int thread = 0; thread < 4; ++thread)
        threads.emplace_back([&, thread] {
            const Cache cache(folder_);
            const std::vector<std::byte> mine(20000, static_cast<std::byte>(thread));
            for (int i = 0; i < 50; ++i) {
                cache.write("shared", mine);
                const auto found = cache.read("shared");
                if (found && (found->size() != mine.size() || found->back() != found->front())) ++damaged;
            }
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(damaged, 0);
    EXPECT_TRUE(Cache(folder_).read("shared"));
    EXPECT_EQ(files(), 1u);
}

TEST(CacheFolder, FollowsTheXdgSpecification) {
    const auto with = [](const char* xdg, const char* home) {
        const auto set = [](const char* name, const char* value) {
            value ? ::setenv(name, value, 1) : ::unsetenv(name);
        };
        const auto saved = [](const char* name) {
            const char* value = std::getenv(name);
            return value ? std::optional<std::string>(value) : std::nullopt;
        };
        const auto old_xdg = saved("XDG_CACHE_HOME"), old_home = saved("HOME");
        set("XDG_CACHE_HOME", xdg);
        set("HOME", home);
        const fs::path folder = default_cache_folder();
        set("XDG_CACHE_HOME", old_xdg ? old_xdg->c_str() : nullptr);
        set("HOME", old_home ? old_home->c_str() : nullptr);
        return folder;
    };
    EXPECT_EQ(with("/x", "/home/a"), "/x/strandlab");
    EXPECT_EQ(with(nullptr, "/home/a"), "/home/a/.cache/strandlab");
    EXPECT_EQ(with("relative", "/home/a"), "/home/a/.cache/strandlab");
    EXPECT_EQ(with("", nullptr), "");
}

TEST(CacheSwitch, NoCacheFindsAndKeepsNothing) {
    set_cache_enabled(false);
    cache_write("cache switch test", bytes_of("x"));
    EXPECT_FALSE(cache_read("cache switch test"));
    set_cache_enabled(true);
}

}  // namespace
}  // namespace strandlab
