// strandlab report: result files of any number of machines as one page.
#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "commands/command.h"
#include "report/html/figures.h"
#include "report/html/page.h"
#include "report/merged_results.h"
#include "report/text_format.h"

#include <nlohmann/json.hpp>

#include <memory>

namespace strandlab {
namespace {

struct Options {
    std::vector<std::string> files;
    std::string output = "report.html", figures;
    PageOptions page;
    bool no_images = false;
};

/// What is missing, on standard error too: a report of a part must not pass for the whole.
void warn_of_gaps(const MergedResults& results) {
    for (const std::string& shard : results.silent_shards) warn("no row came from {}", shard);
    if (results.missing.empty()) return;
    warn("{} cases are missing, the first: {}", grouped(results.missing.size()), results.missing.front());
}

int run(Options& options) {
    const MergedResults results = merge_result_files(options.files);
    if (results.rows.empty() && results.stress.empty())
        fail(ExitCode::bad_input, "{}: no rows; choose files that bench --json or stress --json wrote",
             options.files.front());
    warn_of_gaps(results);
    options.page.pictures = !options.no_images;
    const std::string page = report_page(results, options.page);
    write_file(options.output, page);
    inform("{}: {} rows, {}", options.output, grouped(results.rows.size()), bytes_text(page.size()));
    if (!options.figures.empty())
        inform("{}: {} figures", options.figures, grouped(write_figures(results, options.figures)));
    return 0;
}

}  // namespace

Command report_command() {
    return {
        "report", "one HTML file from result files: what to use when, charts, pictures, all rows",
        "  strandlab report results.jsonl -o report.html\n"
        "  strandlab report shard-*.jsonl stress.jsonl -o report.html --figures figures\n"
        "\n"
        "The file opens without a network. Of rows with the same key the last counts; missing cases of a\n"
        "sharded sweep are named. --figures writes every chart as an SVG file for a paper.\n",
        [](CLI::App& app) -> RunCommand {
            auto options = std::make_shared<Options>();
            app.add_option("files", options->files, "result files of bench and stress (JSON Lines)")
                ->required();
            app.add_option("-o,--output", options->output, "the page")->capture_default_str();
            app.add_option("--figures", options->figures, "folder for the charts as SVG files");
            app.add_option("--title", options->page.title, "heading of the page")->capture_default_str();
            app.add_flag("--no-images", options->no_images, "leave out pictures");
            return [options] { return run(*options); };
        }};
}

}  // namespace strandlab
