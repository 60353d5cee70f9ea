// Models by name: a file, chosen by its extension, or a generator's specification.
#pragma once

#include "strands/files.h"
#include "strands/strands.h"

#include <string>
#include <vector>

namespace strandlab {

/// What a reader gets.
struct ModelInput {
    const ByteSource& source;
    const ByteSource* strands;  // null when none was given
    const CurveOptions& options;
    ImportReport& report;
};

/// One file format.
struct ModelFormat {
    std::string extension;  // ".hair"
    std::string summary;    // one line for help
    Curves (*load)(const ModelInput& input);
    void (*write)(const std::string& path, const Curves& curves,
                  const WriteOptions& options);  // null: read only
    bool takes_strands = false;                  // a second file with the strands may go with it
};

/// All formats, in the order of their names.
const std::vector<ModelFormat>& model_formats();

/// What results call a model: a specification without its prefix, the name of a hair mesh, that of a file
/// without folder and extension.
std::string model_name(const std::string& path);

/// Loads a model. The path may be "generate:NAME,key=value,..." (strands/generators.h) or
/// "FILE.hairmesh,key=value,..." (strands/hair_mesh/model.h); otherwise the extension, in any case, decides.
/// strands_path names the strands of an .npy file. The report says what was passed over. Throws Error
/// (bad_input; usage for a wrong specification or option) in one line.
Curves load_model(const std::string& path, const CurveOptions& options, ImportReport& report,
                  const std::string& strands_path = {});

/// Throws as write_model would for the path's extension and the options: before anything is loaded for it.
void check_output(const std::string& path, const WriteOptions& options = {});

/// Writes a model in the format of the path's extension, whole or not at all. Throws Error (bad_input).
void write_model(const std::string& path, const Curves& curves, const WriteOptions& options = {});

}  // namespace strandlab
