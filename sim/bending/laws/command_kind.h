// What a scene can order at a time.
#pragma once

#include <array>

namespace hysteron {

// iron: the cloth forgets its bends; edit: the present shape becomes the shape at rest (grinspun-edit alone).
enum class CommandKind { iron, edit };
constexpr std::array<const char*, 2> names(CommandKind) { return {"iron", "edit"}; }

}  // namespace hysteron
