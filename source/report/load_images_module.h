// Opens the images module, once, when the first image is asked for.
#pragma once

#include "report/images_module.h"

#include <string>

namespace strandlab {

/// Whether this build has images and the module is where it is looked for; does not open it.
bool has_images();

/// The module's functions. It is looked for next to the program, in the folder above it (the build
/// tree's test programs) and in ../lib/strandlab. Throws Error (usage) naming path, the image that was
/// asked for, when there is none or it does not fit this program.
const ImagesModule& load_images_module(const std::string& path);

}  // namespace strandlab
