// What a scene chooses in bending, with the names of scene files.
#pragma once

#include <array>

#include "sim/base/enum_names.h"

namespace hysteron {

// Numbers along weft and at 45 degrees over that along warp.
struct DirectionRatios {
  double weft = 1, bias = 1;
};

// How angles become curvatures: the tensor of a face, or the angle of a hinge over its length.
enum class BendingElement { shape, hinge };
constexpr std::array<const char*, 2> names(BendingElement) { return {"shape", "hinge"}; }

// Forces: the gradient of the energy, or the chapter's formula, which is of hinges.
enum class ForceConvention { energy, chapter };
constexpr std::array<const char*, 2> names(ForceConvention) { return {"energy", "chapter"}; }

// What a scene can order at a time.

// iron: the cloth forgets its bends; edit: the present shape becomes the shape at rest (grinspun-edit alone).
enum class CommandKind { iron, edit };
constexpr std::array<const char*, 2> names(CommandKind) { return {"iron", "edit"}; }

}  // namespace hysteron
