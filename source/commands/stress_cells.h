// Runs of strandlab stress that judge one tally a family, primitive and device.
#pragma once

#include "base/error.h"
#include "base/file.h"
#include "commands/stress_report.h"
#include "commands/stress_run.h"
#include "report/result_json.h"
#include "report/table.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace strandlab {

/// One primitive on one device over one family.
template <class Tally>
struct DeviceCell {
    const StressFamily* family = nullptr;
    const PrimitiveChoice* choice = nullptr;
    const TraceDevice* device = nullptr;
    Tally tally;
    StressJudgement judgement;
};

/// The cells of a run, those of one family and primitive side by side.
template <class Tally>
class DeviceCells {
  public:
    explicit DeviceCells(const StressRun& run) : run_(run) {
        for (const StressFamily* family : run.families)
            for (const PrimitiveChoice& choice : run.choices)
                for (const auto& device : run.devices)
                    cells_.push_back({family, &choice, device.get(), {}, {}});
    }

    /// One for each device.
    std::span<DeviceCell<Tally>> of(size_t family, size_t choice) {
        const size_t devices = run_.devices.size();
        return std::span(cells_).subspan((family * run_.choices.size() + choice) * devices, devices);
    }

    /// Judges every cell, prints the table and writes the JSON lines that the run asks for; the exit code.
    template <class Judge, class MakeTable, class AddJson>
    int finish(const Judge& judge, const MakeTable& make_table, const AddJson& add_json) {
        bool fails = false;
        std::string lines;
        for (DeviceCell<Tally>& cell : cells_) {
            cell.judgement = judge(cell);
            fails |= cell.judgement.verdict == StressVerdict::fails;
            nlohmann::ordered_json object;
            object["family"] = cell.family->name;
            object["primitive"] = cell.choice->label();
            object["device"] = cell.device->name();
            object["seed"] = run_.seed;
            object["no_skips"] = run_.no_skips;
            add_json(cell, object);
            object["verdict"] = verdict_text(cell.judgement.verdict);
            object["reason"] = cell.judgement.text;
            lines += to_line(object) + "\n";
        }
        std::fputs(make_table(cells_).to_string(standard_output_style()).c_str(), stdout);
        if (!run_.json.empty()) write_file(run_.json, lines);
        return static_cast<int>(fails ? ExitCode::threshold : ExitCode::ok);
    }

  private:
    const StressRun& run_;
    std::vector<DeviceCell<Tally>> cells_;
};

}  // namespace strandlab
