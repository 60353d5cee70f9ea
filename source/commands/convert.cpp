// strandlab convert: reads any model and writes it in another format.
#include "base/error.h"
#include "base/log.h"
#include "commands/arguments.h"
#include "commands/command.h"
#include "commands/usage_error.h"
#include "strands/generators.h"
#include "strands/models.h"

#include <memory>

namespace strandlab {
namespace {

struct Options {
    ModelArguments model;
    std::string strands, output;
    WriteOptions write;
};

int run(const Options& options) {
    if (options.model.models.size() != 1)
        fail(ExitCode::usage, "convert takes one MODEL, not {}", options.model.models.size());
    const std::string& path = options.model.models.front();
    const CurveOptions curve_options = options.model.curve_options();
    check_output(options.output, options.write);
    ImportReport report;
    const Curves curves = load_model(path, curve_options, report, options.strands);
    for (const std::string& line : warnings(report, curve_options)) warn("{}: {}", path, line);
    write_model(options.output, curves, options.write);
    inform("{}: {} strands, {} curves", options.output, curves.strands.size(), curves.curves.size());
    return 0;
}

std::string generator_help() {
    std::string text = "Generators (generate:NAME,key=value,...):\n";
    for (const Generator& generator : generators()) {
        text += fmt::format("  {:<12} {}\n", generator.name, generator.summary);
        for (const ParameterInfo& p : generator.parameters)
            text += fmt::format("               {}={}: {}\n", p.name, p.default_value, p.help);
    }
    return text;
}

}  // namespace

Command convert_command() {
    const std::string examples =
        "  strandlab convert hair.tfx -o hair.hair\n"
        "  strandlab convert hair.hair -o curves.npy --write-strands strands.npy\n"
        "  strandlab convert generate:wavy,strands=500 -o wavy.hair\n" +
        generator_help();
    return {"convert", "read a model, write it as .hair or .npy", examples, [](CLI::App& app) -> RunCommand {
                auto options = std::make_shared<Options>();
                options->model.add_to(app, true);
                app.add_option("--strands", options->strands, "strands of an .npy model, int32 [S,2]");
                app.add_option("-o,--output", options->output, "file to write: .hair or .npy")->required();
                add_write_options(app, options->write);
                return [options] { return run(*options); };
            }};
}

}  // namespace strandlab
