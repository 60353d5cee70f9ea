#include "base/error.h"
#include "primitives/primitive.h"

#include <gtest/gtest.h>

namespace strandlab {
namespace {

std::string message_of(std::string_view text, std::string_view caps = {}) {
    try {
        parse_primitive(text, caps);
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::usage);
        return error.what();
    }
    return "";
}

TEST(PrimitiveOptions, ParsesKeysAndKeepsDefaults) {
    const PrimitiveChoice choice = parse_primitive("lss:segments=8");
    EXPECT_EQ(choice.options.parameters.integer("segments"), 8u);
    EXPECT_EQ(choice.options.caps, Caps::round);
    EXPECT_EQ(choice.label(), "lss:segments=8");
    EXPECT_EQ(parse_primitive("lss").label(), "lss");
}

TEST(PrimitiveOptions, SuggestsTheNearestName) {
    EXPECT_NE(message_of("lsss").find("did you mean 'lss'"), std::string::npos);
    EXPECT_NE(message_of("lss:segment=8").find("did you mean 'segments'"), std::string::npos);
}

TEST(PrimitiveOptions, NamesValueAndRange) {
    EXPECT_NE(message_of("lss:segments=0").find("segments=0 is not a whole number from 1 to 4095"),
              std::string::npos);
    EXPECT_NE(message_of("lss:segments=2.5").find("2.5"), std::string::npos);
    EXPECT_NE(message_of("lss:segments=nan").find("nan"), std::string::npos);
    EXPECT_NE(message_of("lss:segments").find("key=value"), std::string::npos);
}

TEST(PrimitiveOptions, RefusesCapsThatThePrimitiveCannotDo) {
    EXPECT_NE(message_of("lss", "flat").find("lss can do round or open only"), std::string::npos);
    EXPECT_NE(message_of("lss", "oval").find("must be round, open or flat"), std::string::npos);
    EXPECT_EQ(parse_primitive("lss", "open").options.caps, Caps::open);
}

}  // namespace
}  // namespace strandlab
