#include "base/npy.h"

#include "base/file.h"
#include "fuzz/samples.h"
#include "unit/test_folder.h"

#include <gtest/gtest.h>

#include <array>

namespace strandlab {
namespace {

using testing_tools::TestFolder;

const NpyItem curve_item{"<f4", {4, 4}};
const NpyItem number_item{"<f4", {}};

ByteSource source_of(const std::string& bytes) {
    return ByteSource::from_memory("a.npy", samples::as_bytes(bytes));
}

std::string floats(size_t n) { return std::string(n * 4, '\0'); }

std::vector<float> numbers_in(const std::string& bytes) {
    return read_npy<float>(source_of(bytes), number_item);
}

TEST(Npy, RoundTripsEveryItemShape) {
    const TestFolder folder;
    const std::string path = folder / "a.npy";
    const std::vector<std::array<float, 3>> normals{{1, 2, 3}, {-4, 5e-40f, 6}};
    write_npy<std::array<float, 3>>(path, {"<f4", {3}}, normals);
    EXPECT_EQ((read_npy<std::array<float, 3>>(ByteSource::from_file(path), {"<f4", {3}})), normals);
    const std::vector<int32_t> ids{-1, 7, 2147483647};
    write_npy<int32_t>(path, {"<i4", {}}, ids);
    EXPECT_EQ(read_npy<int32_t>(ByteSource::from_file(path), {"<i4", {}}), ids);
    const std::vector<double> times{0.1, 1e300};
    write_npy<double>(path, {"<f8", {}}, times);
    EXPECT_EQ(read_npy<double>(ByteSource::from_file(path), {"<f8", {}}), times);
    write_npy<uint32_t>(path, {"<u4", {}}, std::span<const uint32_t>());
    EXPECT_TRUE(read_npy<uint32_t>(ByteSource::from_file(path), {"<u4", {}}).empty());
}

TEST(Npy, WritesTheBytesThatNumpyWrites) {
    const TestFolder folder;
    write_npy<float>(folder / "a.npy", number_item, std::vector<float>{1.0f});
    const std::string bytes = read_file(folder / "a.npy");
    ASSERT_EQ(bytes.size(), 128u + 4u);
    EXPECT_EQ(bytes.substr(0, 10), std::string("\x93NUMPY\x01\x00\x76\x00", 10));
    EXPECT_EQ(bytes.substr(10, 59), "{'descr': '<f4', 'fortran_order': False, 'shape': (1,), }  ");
    EXPECT_EQ(bytes[127], '\n');
}

TEST(Npy, ReadsAllVersionsKeyOrdersAndQuotes) {
    for (const int version : {1, 2, 3})
        EXPECT_EQ(numbers_in(samples::npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2,), }",
                                          floats(2), version))
                      .size(),
                  2u);
    EXPECT_EQ(
        numbers_in(samples::npy("{\"shape\":(2,),\"fortran_order\":False,\"descr\":\"<f4\"}   ", floats(2)))
            .size(),
        2u);
}

TEST(Npy, RefusesWhatIsNotAnArray) {
    EXPECT_MESSAGE(numbers_in(""), "a.npy: not a .npy file");
    EXPECT_MESSAGE(numbers_in("PK\x03\x04 zip archive"), "a.npy: not a .npy file");
    EXPECT_MESSAGE(numbers_in(samples::npy("{}", "", 4)), "version 4.0 at offset 6 is not 1.0, 2.0 or 3.0");
    EXPECT_MESSAGE(numbers_in(std::string("\x93NUMPY\x01\x00\xff\x00{", 11)),
                   "header: 255 x 1 bytes at offset 10 do not fit");
    EXPECT_MESSAGE(numbers_in(std::string("\x93NUMPY\x02\x00\xff\xff\xff\xff", 12)),
                   "header length 4294967295 at offset 8");
    EXPECT_MESSAGE(numbers_in(std::string("\x93NUMPY\x01\x00", 8)), "header length");
}

TEST(Npy, NamesTheKeyThatIsWrong) {
    const auto message = [](const std::string& dictionary, size_t n = 1) {
        return testing_tools::message_of([&] { numbers_in(samples::npy(dictionary, floats(n))); });
    };
    const auto expect = [&](const std::string& dictionary, const std::string& part) {
        EXPECT_TRUE(testing_tools::contains(message(dictionary), part)) << message(dictionary);
    };
    expect("{'descr': '<f4', 'shape': (1,), }", "has no key 'fortran_order'");
    expect("{'descr': '<f4', 'fortran_order': False}", "has no key 'shape'");
    expect("{}", "has no key 'descr'");
    expect("{'descr': '<f4', 'descr': '<f4'}", "repeated key 'descr'");
    expect("{'other': 1}", "unknown key 'other'");
    expect("{'descr': '>f4', 'fortran_order': False, 'shape': (1,), }", "'descr' is '>f4', need '<f4'");
    expect("{'descr': '<f8', 'fortran_order': False, 'shape': (1,), }", "'descr' is '<f8', need '<f4'");
    expect("{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (1,), }", "structured type");
    expect("{'descr': '<f4', 'fortran_order': True, 'shape': (1,), }",
           "'fortran_order' is True, only C order");
    expect("{'descr': '<f4', 'fortran_order': 0, 'shape': (1,), }",
           "at offset 44: found byte 0x30, expected True or False");
    expect("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 3), }", "'shape' is (1, 3), need (N,)");
    expect("{'descr': '<f4', 'fortran_order': False, 'shape': (), }", "'shape' is (), need (N,)");
    expect("{'descr': '<f4', 'fortran_order': False, 'shape': (1), }", "',' after a single dimension");
    expect("{'descr': '<f4', 'fortran_order': False, 'shape': (-1,), }", "expected a whole number");
    expect("{'descr': '<f4', 'fortran_order': False, 'shape': (99999999999999999999,), }", "below 2^64");
    expect("{'descr': '<f4', 'fortran_order': False, 'shape': (1,), } x", "nothing but spaces");
    expect("{'descr': '<f4", "expected a closing quote");
    expect("{'descr': '<f4', 'fortran_order': False, 'shape': (2,), }",
           "'shape' (2,) needs 8 bytes of data at offset 68, the file has 4");
    expect("{'descr': '<f4', 'fortran_order': False, 'shape': (0,), }", "needs 0 bytes");
}

TEST(Npy, SurvivesShapesWhoseProductOverflows) {
    const std::string bytes = samples::npy(
        "{'descr': '<f4', 'fortran_order': False, 'shape': (288230376151711744, 4, 4), }", floats(16));
    EXPECT_MESSAGE(require_npy(source_of(bytes), curve_item), "needs more than 2^64 bytes");
}

}  // namespace
}  // namespace strandlab
