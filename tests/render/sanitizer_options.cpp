// Graphics drivers keep memory until the process ends; leaks of our own code stay visible.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libEGL\nleak:libOSMesa\nleak:libgallium\nleak:swrast_dri\nleak:libLLVM\nleak:libGLdispatch\n"
         "leak:<unknown module>\n";
}
