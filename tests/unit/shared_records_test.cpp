// Records that share their ends.
#include "scene/shared_records.h"

#include <gtest/gtest.h>

#include <span>
#include <string>

namespace strandlab {
namespace {

/// Records of four letters, of which the last is that of the next record's beginning where it is the same.
Records records_of(const std::string& letters) {
    Records records{{}, 4, 1};
    const auto bytes = std::as_bytes(std::span(letters));
    records.bytes.assign(bytes.begin(), bytes.end());
    return records;
}

std::string text_of(const std::vector<std::byte>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(SharedRecords, RowsOfTheSameLength) {
    const Records two = records_of("abcddefghijkklmn");
    EXPECT_EQ(overlapping_in_a_row(two), 2u);
    EXPECT_EQ(text_of(without_overlaps(two, 2)), "abcdefghijklmn");
    const Records all = records_of("abcddefgghij");
    EXPECT_EQ(overlapping_in_a_row(all), 3u);
    EXPECT_EQ(text_of(without_overlaps(all, 3)), "abcdefghij");
}

TEST(SharedRecords, TheLastRowMayBeShorter) {
    const Records records = records_of("abcddefghijk");
    EXPECT_EQ(overlapping_in_a_row(records), 2u);
    EXPECT_EQ(text_of(without_overlaps(records, 2)), "abcdefghijk");
}

TEST(SharedRecords, RowsThatHappenToMeetAreRowsToo) {
    // The third record begins with the letter that the second ends with: nothing asks for it.
    const Records records = records_of("abcddefgghijjklmnopqqrst");
    EXPECT_EQ(overlapping_in_a_row(records), 4u);
    const Records met = records_of("abcddefgxhijjklmmopqqrst");
    EXPECT_EQ(overlapping_in_a_row(met), 2u);
    EXPECT_EQ(text_of(without_overlaps(met, 2)), "abcdefgxhijklmmopqrst");
}

TEST(SharedRecords, OthersShareNothing) {
    EXPECT_EQ(overlapping_in_a_row(records_of("")), 0u);
    EXPECT_EQ(overlapping_in_a_row(records_of("abcd")), 0u);
    EXPECT_EQ(overlapping_in_a_row(records_of("abcdefgh")), 0u);
    EXPECT_EQ(overlapping_in_a_row(records_of("abcddefghijkxlmnnopq")), 0u);
    Records without = records_of("abcddefg");
    without.overlap = 0;
    EXPECT_EQ(overlapping_in_a_row(without), 0u);
}

}  // namespace
}  // namespace strandlab
