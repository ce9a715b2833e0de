#include "render/contexts.h"

#define EGL_NO_PROTOTYPES
#define EGL_NO_X11
#include <fmt/core.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstring>

namespace hysteron::render {
namespace {

// libEGL's calls are looked up once; extension calls are null where the driver lacks them.
struct Egl {
  PFNEGLGETPROCADDRESSPROC GetProcAddress;
  PFNEGLGETERRORPROC GetError;
  PFNEGLQUERYSTRINGPROC QueryString;
  PFNEGLINITIALIZEPROC Initialize;
  PFNEGLBINDAPIPROC BindAPI;
  PFNEGLCHOOSECONFIGPROC ChooseConfig;
  PFNEGLCREATECONTEXTPROC CreateContext;
  PFNEGLDESTROYCONTEXTPROC DestroyContext;
  PFNEGLCREATEPBUFFERSURFACEPROC CreatePbufferSurface;
  PFNEGLDESTROYSURFACEPROC DestroySurface;
  PFNEGLMAKECURRENTPROC MakeCurrent;
  PFNEGLGETPLATFORMDISPLAYEXTPROC GetPlatformDisplay;
  PFNEGLQUERYDEVICESEXTPROC QueryDevices;
  PFNEGLQUERYDEVICESTRINGEXTPROC QueryDeviceString;
  PFNEGLQUERYDEVICEATTRIBEXTPROC QueryDeviceAttrib;

  Egl() {
    const SharedLibrary library({"libEGL.so.1", "libEGL.so"});
    library.load("eglGetProcAddress", GetProcAddress);
    library.load("eglGetError", GetError);
    library.load("eglQueryString", QueryString);
    library.load("eglInitialize", Initialize);
    library.load("eglBindAPI", BindAPI);
    library.load("eglChooseConfig", ChooseConfig);
    library.load("eglCreateContext", CreateContext);
    library.load("eglDestroyContext", DestroyContext);
    library.load("eglCreatePbufferSurface", CreatePbufferSurface);
    library.load("eglDestroySurface", DestroySurface);
    library.load("eglMakeCurrent", MakeCurrent);
    load_extension("eglGetPlatformDisplayEXT", GetPlatformDisplay);
    load_extension("eglQueryDevicesEXT", QueryDevices);
    load_extension("eglQueryDeviceStringEXT", QueryDeviceString);
    load_extension("eglQueryDeviceAttribEXT", QueryDeviceAttrib);
  }

 private:
  template <class Function>
  void load_extension(const char* name, Function& function) {
    function = reinterpret_cast<Function>(GetProcAddress(name));
  }
};

const Egl& egl() {
  static const Egl table;
  return table;
}

bool has_extension(const char* extensions, const char* name) {
  const size_t length = std::strlen(name);
  for (const char* at = extensions; at && (at = std::strstr(at, name)); at += length)
    if (at[length] == ' ' || at[length] == '\0') return true;
  return false;
}

std::vector<EGLDeviceEXT> query_devices() {
  EGLint count = 0;
  if (!egl().QueryDevices || !egl().QueryDevices(0, nullptr, &count) || count == 0) return {};
  std::vector<EGLDeviceEXT> devices(static_cast<size_t>(count));
  egl().QueryDevices(count, devices.data(), &count);
  devices.resize(static_cast<size_t>(count));
  return devices;
}

int cuda_device_index(EGLDeviceEXT device, const char* extensions) {
  EGLAttrib index = -1;
  if (!has_extension(extensions, "EGL_NV_device_cuda") || !egl().QueryDeviceAttrib) return -1;
  return egl().QueryDeviceAttrib(device, EGL_CUDA_DEVICE_NV, &index) ? static_cast<int>(index) : -1;
}

Candidate describe_device(EGLDeviceEXT device, int index) {
  const char* extensions = egl().QueryDeviceString ? egl().QueryDeviceString(device, EGL_EXTENSIONS) : "";
  return {.kind = Candidate::Kind::egl_device,
          .device = index,
          .hardware = !has_extension(extensions, "EGL_MESA_device_software"),
          .cuda_device = cuda_device_index(device, extensions)};
}

Error egl_error(const char* attempted) {
  return Error::system(
      fmt::format("{} fails with EGL error 0x{:04x}", attempted, static_cast<unsigned>(egl().GetError())));
}

class EglContext : public Offscreen {
 public:
  explicit EglContext(const Candidate& candidate) : Offscreen(candidate) {
    open_display(candidate);
    try {
      create_context();
      make_current();
      describe(egl().GetProcAddress);
    } catch (...) {
      release();
      throw;
    }
  }
  ~EglContext() override { release(); }

  void make_current() override {
    // Drawing goes to framebuffer objects; a surface only serves drivers without EGL_KHR_surfaceless_context.
    if (egl().MakeCurrent(display_, surface_, surface_, context_)) return;
    const EGLint size[] = {EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
    if (surface_ == EGL_NO_SURFACE && config_) surface_ = egl().CreatePbufferSurface(display_, config_, size);
    if (!egl().MakeCurrent(display_, surface_, surface_, context_)) throw egl_error("eglMakeCurrent");
  }

 private:
  void open_display(const Candidate& candidate) {
    if (!egl().GetPlatformDisplay) throw Error::system("EGL has no eglGetPlatformDisplayEXT");
    if (candidate.kind == Candidate::Kind::egl_device) {
      const auto devices = query_devices();
      if (candidate.device < 0 || candidate.device >= static_cast<int>(devices.size()))
        throw Error::system("EGL has " + std::to_string(devices.size()) + " devices");
      display_ = egl().GetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[candidate.device], nullptr);
    } else {
      display_ = egl().GetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    }
    if (display_ == EGL_NO_DISPLAY) throw egl_error("eglGetPlatformDisplayEXT");
    if (!egl().Initialize(display_, nullptr, nullptr)) throw egl_error("eglInitialize");
  }

  void create_context() {
    const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLint count = 0;
    if (!egl().ChooseConfig(display_, wanted, &config_, 1, &count) || count == 0) config_ = EGL_NO_CONFIG_KHR;
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                              3,
                              EGL_CONTEXT_MINOR_VERSION,
                              3,
                              EGL_CONTEXT_OPENGL_PROFILE_MASK,
                              EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                              EGL_NONE};
    if (!egl().BindAPI(EGL_OPENGL_API)) throw egl_error("eglBindAPI(EGL_OPENGL_API)");
    context_ = egl().CreateContext(display_, config_, EGL_NO_CONTEXT, version);
    if (context_ == EGL_NO_CONTEXT) throw egl_error("eglCreateContext for OpenGL 3.3 core");
  }

  // The display stays initialised: other contexts of this process may share it.
  void release() {
    egl().MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (surface_ != EGL_NO_SURFACE) egl().DestroySurface(display_, surface_);
    if (context_ != EGL_NO_CONTEXT) egl().DestroyContext(display_, context_);
  }

  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLConfig config_ = nullptr;
  EGLContext context_ = EGL_NO_CONTEXT;
  EGLSurface surface_ = EGL_NO_SURFACE;
};

}  // namespace

std::string egl_unavailable() {
  try {
    egl();
    return "no device and no surfaceless platform";
  } catch (const Error& error) {
    return error.what();
  }
}

std::vector<Candidate> egl_candidates() {
  std::vector<Candidate> list;
  try {
    const auto devices = query_devices();
    for (size_t i = 0; i < devices.size(); ++i)
      list.push_back(describe_device(devices[i], static_cast<int>(i)));
    const char* client = egl().QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (has_extension(client, "EGL_MESA_platform_surfaceless"))
      list.push_back({.kind = Candidate::Kind::egl_surfaceless});
  } catch (const Error&) {
    return {};  // no libEGL: egl_unavailable() says why
  }
  return list;
}

std::unique_ptr<Offscreen> create_egl_context(const Candidate& candidate) {
  return std::make_unique<EglContext>(candidate);
}

}  // namespace hysteron::render
