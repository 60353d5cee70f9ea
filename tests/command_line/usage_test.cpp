// Command lines that are wrong, and help.
#include "command_line/program.h"

#include <algorithm>
#include <csignal>
#include <sstream>

namespace strandlab::testing_tools {
namespace {

using UsageTest = CommandLineTest;

struct BadCommandLine {
    Arguments arguments;
    std::vector<std::string> parts;  // of the message
};

TEST_F(UsageTest, NamesWhatIsWrongWithCommandsAndOptions) {
    const std::vector<BadCommandLine> all{
        {{}, {"no command", "bench", "convert", "strandlab --help"}},
        {{"--quiet"}, {"no command", "bench"}},
        {{"bnech"}, {"'bnech'", "did you mean 'bench'?", "validate"}},
        {{"--threads", "1", "bnech"}, {"'bnech'", "did you mean 'bench'?"}},
        {{"xyzzyxyzzy"}, {"'xyzzyxyzzy'", "there are bench"}},
        {{"--nope"}, {"'--nope'", "strandlab --help"}},
        {{"bench", "--repeet", "3"}, {"'--repeet'", "did you mean '--repeat'?", "strandlab bench --help"}},
        {{"bench", "--repeet=3"}, {"'--repeet'", "did you mean '--repeat'?"}},
        {{"bench", "--thraeds", "3"}, {"'--thraeds'", "did you mean '--threads'?"}},
        {{"trace", "--curvs", "c.npy"}, {"'--curvs'", "did you mean '--curves'?"}},
        {{"info", "extra"}, {"'extra'", "info takes no such argument", "strandlab info --help"}},
        {{"bench", "--resolution"}, {"--resolution", "missing", "strandlab bench --help"}},
        {{"trace"}, {"--curves is required", "strandlab trace --help"}},
        {{"render", "x.hair"}, {"required", "strandlab render --help"}},
        {{"render", "-o", "x.png"}, {"MODEL", "required"}},
        {{"render", "a.hair", "b.hair", "-o", "x.png"}, {"one MODEL", "not 2"}},
        {{"convert", "a.hair", "b.hair", "-o", "x.hair"}, {"one MODEL", "not 2"}},
        {{"trace", "--curves", "c", "--rays", "r", "--out", "d"}, {"--primitive"}},
        {{"bench", "--no-normals", "--images", "d"}, {"--no-normals", "--images"}},
    };
    for (const BadCommandLine& bad : all) expect_failure(run(bad.arguments), 2, bad.parts);
}

/// Options of bench with a value that they cannot have.
struct BadValue {
    std::string option, value;
    std::vector<std::string> parts;
};

TEST_F(UsageTest, NamesOptionAndValueThatCannotBe) {
    const std::vector<BadValue> all{
        {"--repeat", "0", {"--repeat", "0 is not a whole number from 1 to 10000"}},
        {"--repeat", "abc", {"--repeat", "abc"}},
        {"--repeat", "1.5", {"--repeat", "1.5"}},
        {"--seed", "-3", {"--seed", "-3"}},
        {"--seed", "99999999999999999999", {"--seed", "99999999999999999999"}},
        {"--error-rays", "-1", {"--error-rays", "-1"}},
        {"--threads", "x", {"--threads", "x"}},
        {"--threads", "-1", {"--threads", "-1"}},
        {"--radius", "abc", {"--radius", "abc"}},
        {"--radius", "nan", {"--radius", "nan"}},
        {"--radius", "-1", {"--radius", "-1"}},
        {"--radius-tip", "inf", {"--radius-tip", "inf"}},
        {"--unit-scale", "0", {"--unit-scale", "0 is not a number from 1e-9"}},
        {"--basis", "cubic", {"--basis cubic", "centripetal, uniform, linear or bspline"}},
        {"--caps", "square", {"--caps square", "round, open or flat"}},
        {"--leaf-order", "best", {"--leaf-order best", "auto, file or median"}},
        {"--rays", "primry", {"primry", "did you mean 'primary'?", "diffuse"}},
        {"--resolution", "640", {"--resolution 640", "WIDTHxHEIGHT"}},
        {"--resolution", "0x5", {"--resolution 0x5"}},
        {"--resolution", "5x", {"--resolution 5x"}},
        {"--resolution", "1.5x2", {"--resolution 1.5x2"}},
        {"--resolution", "40000x2", {"--resolution 40000x2", "32768"}},
        {"--resolution", "nanxnan", {"--resolution nanxnan"}},
        {"--camera", "from=0,0,0", {"--camera", "from=0,0,0"}},
        {"--camera", "form=0,0,1", {"--camera", "did you mean 'from'?"}},
        {"--camera", "from=1,2", {"--camera", "from=1,2", "x,y,z"}},
        {"--camera", "from=1,2,nan", {"--camera", "nan"}},
        {"--camera", "eye=0,0,1", {"--camera", "target"}},
        {"--camera", "eye=0,0,1:target=0,0,1", {"--camera", "different points"}},
        {"--camera", "eye=0,0,1:target=0,0,0:zoom=2", {"--camera", "zoom"}},
        {"--camera", "zoom", {"--camera", "zoom", "key=value"}},
        {"--primitive", "los", {"--primitive los", "did you mean 'lss'?", "rocaps"}},
        {"--primitive", "cylinders", {"--primitive cylinders", "there are dots"}},
        {"--primitive", "lss:segmnts=3", {"--primitive lss", "'segmnts'", "did you mean 'segments'?"}},
        {"--primitive", "lss:segments=0", {"segments=0", "from 1 to 4095"}},
        {"--primitive", "lss:segments=", {"segments="}},
        {"--primitive", "lss:segments=2.5", {"segments=2.5", "whole number"}},
        {"--primitive", "lss:segments=4,tolerance=nan", {"tolerance=nan"}},
        {"--primitive", "lss:segments", {"'segments'", "key=value"}},
        {"--primitive", "prhi:variant=exact", {"variant=exact", "published", "robust"}},
    };
    for (const BadValue& bad : all)
        expect_failure(run({"bench", "nowhere.hair", bad.option, bad.value}), 2, bad.parts);
}

TEST_F(UsageTest, SaysWhichCapsAPrimitiveCanDo) {
    expect_failure(run({"bench", "generate:fur", "--primitive", "prhi", "--caps", "round"}), 2,
                   {"--caps round", "prhi", "open"});
    expect_failure(run({"render", "generate:fur", "--primitive", "dots", "--caps", "flat", "-o", "x.exr"}), 2,
                   {"--caps flat", "dots", "open"});
    expect_failure(run({"compare", "--curves", "generate:case,case=arc", "--rays", "r.npy", "--hits", "d",
                        "--surface", "sphre"}),
                   5, {"r.npy"});
}

TEST_F(UsageTest, TakesPrimitivesBeforeAndAfterTheModel) {
    for (const Arguments& arguments :
         {Arguments{"--primitive", "lss:segments=3,tolerance=0.5", "--primitive",
                    "prhi:variant=published,"
                    "iterations=40",
                    "generate:case,case=arc,size=2"},
          Arguments{"generate:case,case=arc,size=2", "--primitive", "lss:segments=3,tolerance=0.5",
                    "--primitive", "prhi:variant=published,iterations=40"}}) {
        Arguments all{"bench", "--device", "cpu-float", "--resolution", "16x16", "--rays", "primary"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const Outcome outcome = run(all);
        expect_success(outcome);
        EXPECT_TRUE(contains(outcome.output, "lss:segments=3,tolerance=0.5")) << outcome.output;
        EXPECT_TRUE(contains(outcome.output, "prhi:variant=published")) << outcome.output;
    }
}

/// The words of a line as a shell would split it (single quotes only).
Arguments words_of(const std::string& line) {
    Arguments words;
    std::string word;
    bool quoted = false, any = false;
    for (const char c : line + " ") {
        if (c == '\'') {
            quoted = !quoted;
            any = true;
        } else if (c == ' ' && !quoted) {
            if (any) words.push_back(word);
            word.clear();
            any = false;
        } else {
            word += c;
            any = true;
        }
    }
    return words;
}

/// The commands that the help lists.
std::vector<std::string> commands_in(const std::string& help) {
    std::vector<std::string> names;
    std::istringstream lines(help.substr(help.find("Subcommands:")));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line) && line.rfind("  ", 0) == 0) {
        if (line[2] != ' ') names.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
    return names;
}

TEST_F(UsageTest, EveryCommandHasHelpWithExamplesThatParse) {
    const Outcome overview = run({"--help"});
    expect_success(overview);
    EXPECT_EQ(overview.log, "");
    EXPECT_TRUE(contains(overview.output, "Exit codes: 0 ok"));
    const std::vector<std::string> commands = commands_in(overview.output);
    for (const char* name : {"bench", "validate", "trace", "compare", "render", "convert", "info"})
        EXPECT_NE(std::find(commands.begin(), commands.end(), name), commands.end()) << name;
    for (const std::string& command : commands) {
        const Outcome help = run({command, "--help"});
        expect_success(help);
        EXPECT_EQ(help.log, "");
        std::istringstream lines(
            help.output.substr(std::min(help.output.find("Examples:"), help.output.size())));
        size_t examples = 0;
        for (std::string line; std::getline(lines, line);) {
            if (line.rfind("  strandlab ", 0) != 0) continue;
            ++examples;
            // What two spaces set apart is a remark.
            Arguments words = words_of(line.substr(0, line.find("  ", 2)));
            words.erase(words.begin());
            EXPECT_EQ(words.front(), command) << line;
            // Without a device and without the files only errors are left that are none of usage.
            const Outcome outcome = run_for_a_second(words, no_vulkan);
            EXPECT_NE(outcome.code, 2) << line << "\n" << outcome.log;
            EXPECT_TRUE(outcome.code <= 5 || outcome.code == 128 + SIGKILL) << line << "\n" << outcome.log;
        }
        EXPECT_GE(examples, 1u) << command;
    }
}

TEST_F(UsageTest, PrintsItsVersion) {
    const Outcome outcome = run({"--version"});
    expect_success(outcome);
    EXPECT_EQ(outcome.output.rfind("strandlab " STRANDLAB_VERSION " (commit ", 0), 0u) << outcome.output;
    EXPECT_EQ(outcome.log, "");
}

}  // namespace
}  // namespace strandlab::testing_tools
