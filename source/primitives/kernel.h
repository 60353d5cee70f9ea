// What kernels of primitives are written with.
#pragma once

#include "base/kernel.h"
