// Choices of a scene in bending, with the names of scene files.
#pragma once

#include <array>

#include "sim/base/enum_names.h"

namespace hysteron {

// Ratios of a quantity along weft and at 45 degrees to that along warp.
struct DirectionRatios {
  double weft = 1, bias = 1;
};

// The element decides how angles become curvatures: shape is the tensor of a face, hinge an angle over its
// length.
enum class BendingElement { shape, hinge };
constexpr std::array<const char*, 2> names(BendingElement) { return {"shape", "hinge"}; }

// energy takes forces as the gradient of the energy; chapter is the chapter's formula, for hinges alone.
enum class ForceConvention { energy, chapter };
constexpr std::array<const char*, 2> names(ForceConvention) { return {"energy", "chapter"}; }

// Commands that a scene can give at a time.

// iron makes the cloth forget its bends; edit makes the present shape the shape at rest (grinspun-edit
// alone).
enum class CommandKind { iron, edit };
constexpr std::array<const char*, 2> names(CommandKind) { return {"iron", "edit"}; }

}  // namespace hysteron
