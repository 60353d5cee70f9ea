// strandlab stress --self-intersection.
#include "commands/stress_cells.h"
#include "measure/stress_spawn.h"
#include "report/text_format.h"

namespace strandlab {
namespace {

using Cell = DeviceCell<SpawnTally>;

/// Whether several offsets were tried.
bool has_ladder(const Cell& cell) { return cell.device->gpu() == nullptr; }

std::string needed_text(const Cell& cell, double value) {
    return !has_ladder(cell) ? "-" : value == 0 ? "0" : significant(value, 2);
}

Table table_of(const std::vector<Cell>& cells) {
    Table table({{"family", "", true},
                 {"primitive", "", true},
                 {"device", "", true},
                 {"hits left"},
                 {"rays"},
                 {"self-hits", "unmoved"},
                 {"needs", "radii"},
                 {"needs", "ulp"},
                 {"moved by", "radii"},
                 {"or", "ulp"},
                 {"self-hits", "moved"},
                 {"own hits", "right"},
                 {"shadow rays"},
                 {"differ"},
                 {"verdict", "", true}},
                3);
    for (const Cell& cell : cells) {
        const SpawnTally& t = cell.tally;
        const SpawnOffset& offset = cell.choice->primitive->spawn;
        table.add_row({cell.family->name, cell.choice->label(), device_text(cell.device->name()),
                       grouped(t.hits), grouped(t.rays), has_ladder(cell) ? grouped(t.unmoved) : "-",
                       needed_text(cell, t.radii_needed), needed_text(cell, t.ulps_needed),
                       significant(offset.radii, 2), significant(offset.ulps, 2), grouped(t.self_hits),
                       grouped(t.own_hits), grouped(t.shadow_rays), grouped(t.shadow_differs),
                       std::string(verdict_text(cell.judgement.verdict))});
    }
    return table;
}

void add_json(const Cell& cell, nlohmann::ordered_json& object) {
    const SpawnTally& t = cell.tally;
    const SpawnOffset& offset = cell.choice->primitive->spawn;
    object["hits"] = t.hits;
    object["rays"] = t.rays;
    object["offset"] = {{"radii", offset.radii}, {"ulps", offset.ulps}};
    object["self_hits"] = rate_json(t.self_hits, t.rays);
    if (has_ladder(cell)) {
        object["self_hits_unmoved"] = rate_json(t.unmoved, t.rays);
        object["needs"] = {{"radii", json_number(t.radii_needed)}, {"ulps", json_number(t.ulps_needed)}};
    }
    object["own_hits"] = t.own_hits;
    object["shadow_differs"] = rate_json(t.shadow_differs, t.shadow_rays);
}

void add_chunk(const StressChunk& chunk, std::span<Cell> cells, std::span<StressDevice> devices) {
    const Primitive& primitive = *chunk.choice.primitive;
    const StressRange& range = chunk.pairs.range;
    const std::vector<SpawnPoint> points =
        spawn_points(primitive, chunk.geometry, chunk.surface, chunk.pairs);
    for (size_t d = 0; d < cells.size(); ++d) {
        Cell& cell = cells[d];
        if (!devices[d].is_gpu()) {
            add_spawned(primitive, chunk.geometry, chunk.surface, range, points, cell.tally);
            continue;
        }
        // The rays start near the strands, whose boxes know their own size.
        const PairScene scene = devices[d].scene(primitive, chunk.geometry, range, 0);
        add_spawned(scene, primitive, chunk.surface, range, points, cell.tally);
    }
}

}  // namespace

int run_self_intersection(const StressRun& run) {
    for (const auto& device : run.devices)
        if (device->name() == "cpu-double")
            fail(ExitCode::usage,
                 "--device cpu-double: --self-intersection is about float; pass cpu-float or a device");
    DeviceCells<SpawnTally> cells(run);
    std::vector<StressDevice> devices = devices_of(run);
    for_each_chunk(run, "self-intersection", [&](size_t family, size_t choice, const StressChunk& chunk) {
        add_chunk(chunk, cells.of(family, choice), devices);
    });
    return cells.finish(
        [](const Cell& cell) { return judge_spawned(cell.tally, *cell.choice->primitive, *cell.family); },
        table_of, add_json);
}

}  // namespace strandlab
