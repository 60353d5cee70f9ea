// Options that several commands share, and what they become.
#pragma once

#include "gpu/device.h"
#include "primitives/primitive.h"
#include "scene/scene.h"
#include "strands/files.h"
#include "strands/strands.h"
#include "trace/traversal.h"

#include <CLI/CLI.hpp>

#include <string>
#include <utility>
#include <vector>

namespace strandlab {

/// How models are read.
struct ModelArguments {
    std::vector<std::string> models;
    std::string basis = "centripetal";
    float radius = 35e-6f, radius_tip = 10e-6f, unit_scale = 1.0f;

    void add_to(CLI::App& app, bool required);
    /// Throws Error (usage) for values out of range.
    CurveOptions curve_options() const;
    /// The options that were given, with their values.
    std::vector<std::pair<std::string, std::string>> given() const;

  private:
    CLI::App* app_ = nullptr;
    CLI::Option* radius_option_ = nullptr;
    CLI::Option* radius_tip_option_ = nullptr;
};

/// Adds how a model is written.
void add_write_options(CLI::App& app, WriteOptions& options);

/// Which primitives, and how strand ends are closed.
struct PrimitiveArguments {
    std::vector<std::string> primitives;
    std::string caps;

    /// several: the option may be repeated.
    void add_to(CLI::App& app, bool several);
    /// The choices, each once; with none given, every primitive but the diagnostic ones, with its defaults.
    std::vector<PrimitiveChoice> choices() const;
    /// The mode of the common reference: the one asked for, else round.
    Caps scene_caps() const;

  private:
    bool several_ = true;
};

/// Of the option --bytes-per-curve.
inline constexpr const char* bytes_per_curve_help =
    "splits as many as keep structures and records within so many bytes for each curve, where they are of "
    "most use, instead of splits=N (0: as the primitives say)";

/// Which device.
struct DeviceArguments {
    std::string device;
    bool validation = false;
    std::string traversal = "pipeline";

    void add_to(CLI::App& app);
    /// Throws Error (usage) for a traversal that there is not.
    DeviceOptions options() const;
    Traversal asked_traversal() const { return parse_traversal(traversal); }
};

/// The text below the options of a command that takes primitives: every primitive with its parameters.
std::string primitive_help();

/// "WIDTHxHEIGHT".
struct Resolution {
    uint32_t width = 0, height = 0;
};
Resolution parse_resolution(const std::string& text);

}  // namespace strandlab
