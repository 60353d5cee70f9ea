// strandlab bench: run time against memory and error, one row per case.
#include "base/error.h"
#include "base/file.h"
#include "commands/ablation.h"
#include "commands/bench_options.h"
#include "commands/bench_run.h"
#include "commands/command.h"
#include "commands/lod.h"
#include "report/article_table.h"
#include "report/baseline.h"
#include "report/html/scale_chart.h"
#include "report/merge.h"
#include "report/result_json.h"
#include "report/result_table.h"
#include "report/scale_table.h"
#include "report/words.h"

#include <fmt/format.h>

#include <memory>

namespace strandlab {
namespace {

/// --lod: the sweep of levels of detail, with what of the options says how.
int run_detail(const BenchOptions& options) {
    if (options.models.models.empty())
        fail(ExitCode::usage, "--lod: name a hair mesh, such as models/ringlets.hairmesh,strands=20000");
    LodOptions lod;
    lod.primitives = options.primitives;
    lod.device = options.device;
    lod.camera = options.rays.camera;
    lod.json = options.json;
    lod.charts = options.images;
    lod.seed = options.rays.seed;
    if (options.repeat) lod.repeat = *options.repeat;
    for (const std::string& model : options.models.models) {
        lod.model = model;
        if (options.rays.resolution.empty()) {
            run_lod(lod);
            continue;
        }
        for (const Resolution& resolution : options.resolutions()) {
            lod.resolution = to_string(resolution);
            run_lod(lod);
        }
    }
    return 0;
}

int run(BenchOptions& options) {
    options.check();
    if (options.lod) return run_detail(options);
    if (options.explain || options.ablation) {
        print_ablation(options, options.ablation);
        return 0;
    }
    std::vector<nlohmann::ordered_json> baseline;
    if (!options.baseline.empty()) baseline = merged_rows(read_json_lines(options.baseline));
    BenchRun bench(options);
    bench.run();
    bench.check_device();
    if (options.preset == "article") fmt::print("\n{}", article_table(bench.rows()));
    if (options.preset == "scale") fmt::print("\n{}", scale_table(bench.rows()));
    if (!options.scale_chart.empty()) write_file(options.scale_chart, scale_chart(bench.rows()));
    fmt::print("\n");
    for (const std::string& sentence : result_words(bench.rows())) fmt::print("{}\n", sentence);
    fmt::print("\n{}", result_legend());
    if (options.baseline.empty()) return 0;
    const BaselineComparison comparison = compare_with_baseline(bench.rows(), baseline);
    fmt::print("\n{}", to_text(comparison));
    return static_cast<int>(comparison.is_worse() ? ExitCode::threshold : ExitCode::ok);
}

}  // namespace

Command bench_command() {
    return {
        "bench", "compare primitives: time, memory and error",
        "  strandlab bench\n"
        "  strandlab bench hair.hair --primitive 'lss:segments=1,2,4,8' --primitive 'prhi:splits=1..8' "
        "--rays "
        "primary --rays shadow\n"
        "  strandlab bench hair.tfx --resolution 1280x720,1920x1080 --json results.jsonl --images pictures\n"
        "  strandlab bench --preset full --json results.jsonl --resume --shard 2/8\n"
        "  strandlab bench --lod models/ringlets.hairmesh,strands=20000 --images charts --json detail.jsonl\n"
        "  strandlab bench --json new.jsonl --baseline old.jsonl\n" +
            primitive_help(),
        [](CLI::App& app) -> RunCommand {
            auto options = std::make_shared<BenchOptions>();
            options->add_to(app);
            return [options] { return run(*options); };
        }};
}

}  // namespace strandlab
