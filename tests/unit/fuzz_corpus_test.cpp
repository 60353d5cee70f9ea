// Every input that a fuzzer ever found something with, the seeds, and damaged seeds, through the functions
// that are fuzzed (tests/fuzz).
#include "base/random.h"
#include "fuzz/fuzz_target.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace strandlab::fuzz {
namespace {

class Fuzz : public testing::TestWithParam<FuzzTarget> {
  protected:
    // Thousands of warnings about files are no news here.
    void SetUp() override { testing::internal::CaptureStderr(); }
    void TearDown() override { testing::internal::GetCapturedStderr(); }

    void run(const std::string& bytes, const std::string& what) const {
        EXPECT_NO_THROW(GetParam().run({reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()}))
            << what;
    }
};

TEST_P(Fuzz, WhatWasFoundStaysFixed) {
    const auto folder = std::filesystem::path(STRANDLAB_FUZZ_FOUND) / GetParam().name;
    if (!std::filesystem::exists(folder)) return;  // nothing was ever found
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        std::ifstream file(entry.path(), std::ios::binary);
        ASSERT_TRUE(file) << entry.path();
        run({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()}, entry.path().string());
    }
}

TEST_P(Fuzz, SeedsAndDamagedSeedsAreNoFindings) {
    const std::vector<std::string> seeds = GetParam().seeds();
    ASSERT_FALSE(seeds.empty());
    for (size_t i = 0; i < seeds.size(); ++i) run(seeds[i], "seed " + std::to_string(i));
    for (uint64_t trial = 0; trial < 4000; ++trial) {
        Random random(41, 0, trial);
        std::string bytes = seeds[random.below(uint32_t(seeds.size()))];
        if (bytes.empty()) continue;
        for (uint32_t n = 1 + random.below(6); n > 0; --n)
            bytes[random.below(uint32_t(bytes.size()))] = static_cast<char>(random.bits() >> 8);
        if (random.below(8) == 0) bytes.resize(random.below(uint32_t(bytes.size())));
        run(bytes, "trial " + std::to_string(trial));
    }
}

TEST_P(Fuzz, DeepNestingIsRefusedOrRead) {
    const std::string deep = std::string(200'000, '[') + std::string(200'000, ']');
    run("{\"a\": " + deep + "}\n", "a deep value");
    run("{\"models\": [{\"file\": \"a.hair\", \"radius\": " + deep + "}]}", "a deep number");
}

INSTANTIATE_TEST_SUITE_P(Targets, Fuzz, testing::ValuesIn(fuzz_targets().begin(), fuzz_targets().end()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace strandlab::fuzz
