// Whether a driver crashes, found out by a child process.
#pragma once

#include <functional>
#include <string>

#include "render/offscreen.h"

namespace hysteron::render {

// Calls it in a child process that says nothing, and waits.  Throws Error::system if a signal ends the child,
// or it takes longer than ten seconds: "it ends by a signal (Segmentation fault)".  What the call throws is
// no crash.
void try_in_child(const std::function<void()>& call);

// "GALLIUM_DRIVER = zink" where the environment names a driver of Mesa that is none of its own software
// renderers; empty otherwise.
std::string named_driver();

// Where a driver is named, a context that would be drawn in software is created in a child process first:
// Mesa's OSMesa crashes with drivers that need a window system.  Throws Error::system if it does.  Costs
// nothing where none is named.
void require_no_crash(const Candidate& candidate);

}  // namespace hysteron::render
