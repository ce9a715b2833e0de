// A child process finds out whether a driver crashes.
#pragma once

#include <functional>
#include <string>

#include "render/offscreen.h"

namespace hysteron::render {

// Runs `call` in a silent child process and waits.  Throws Error::system if a signal ends the child ("it ends
// by a signal (Segmentation fault)") or it takes longer than ten seconds.  An exception from `call` is no
// crash.
void try_in_child(const std::function<void()>& call);

// Returns "GALLIUM_DRIVER = zink" if the environment names a driver of Mesa other than its own software
// renderers; empty otherwise.
std::string named_driver();

// Creates a context that would be drawn in software in a child process first if a driver is named, because
// Mesa's OSMesa crashes with drivers that need a window system.  Throws Error::system if the child crashes.
void require_no_crash(const Candidate& candidate);

}  // namespace hysteron::render
