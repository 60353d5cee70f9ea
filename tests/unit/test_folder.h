// A folder that lives as long as a test, and the message that something throws.
#pragma once

#include "base/error.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string>
#include <system_error>

namespace strandlab::testing_tools {

class TestFolder {
  public:
    TestFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "strandlab-test-XXXXXX").string();
        if (!::mkdtemp(name.data()))
            throw std::filesystem::filesystem_error("mkdtemp",
                                                    std::error_code(errno, std::generic_category()));
        path_ = name;
    }
    ~TestFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TestFolder(const TestFolder&) = delete;
    TestFolder& operator=(const TestFolder&) = delete;

    const std::string& path() const { return path_; }
    std::string operator/(const std::string& name) const { return path_ + "/" + name; }
    size_t entries() const {
        const std::filesystem::directory_iterator begin(path_);
        return static_cast<size_t>(std::distance(begin, std::filesystem::directory_iterator()));
    }

  private:
    std::string path_;
};

/// The text of the Error that action throws, which must have this code; "" when it throws none.
template <class Action>
std::string message_of(Action&& action, ExitCode code = ExitCode::bad_input) {
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.code, code) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    return "";
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// EXPECT that the message of an action holds a part, showing both.
#define EXPECT_MESSAGE(action, part)                                                          \
    do {                                                                                      \
        const std::string text = ::strandlab::testing_tools::message_of([&] { action; });     \
        EXPECT_TRUE(::strandlab::testing_tools::contains(text, part)) << "message: " << text; \
    } while (false)

}  // namespace strandlab::testing_tools
