// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Device/OpenCL.h"

#include "Core/Parallel/Forks.h"

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif

namespace RectifiedTransport
{

namespace
{

class Library
{
public:
  // It is never closed: drivers do not survive it.
  Library()
  {
#ifdef _WIN32
    this->Handle = LoadLibraryA("OpenCL.dll");
#else
    this->Handle = dlopen("libOpenCL.so.1", RTLD_NOW | RTLD_LOCAL);
#endif
  }

  template <class Function>
  bool Find(const char* name, Function& function) const
  {
    if (this->Handle)
    {
#ifdef _WIN32
      function = reinterpret_cast<Function>(GetProcAddress(this->Handle, name));
#else
      function = reinterpret_cast<Function>(dlsym(this->Handle, name));
#endif
    }
    return function != nullptr;
  }

private:
#ifdef _WIN32
  HMODULE Handle;
#else
  void* Handle;
#endif
};

struct Loading
{
  OpenCL Functions;
  bool IsComplete = true;
  const int Forks = forksSinceLoad();

  Loading()
  {
    const Library library;
#define RectifiedTransport_FIND(name)                                                              \
  this->IsComplete = library.Find(#name, this->Functions.name) && this->IsComplete
    RectifiedTransport_FUNCTIONS(RectifiedTransport_FIND);
#undef RectifiedTransport_FIND
  }
};

const Loading& loaded()
{
  static const Loading loading;
  return loading;
}

} // namespace

const OpenCL* OpenCL::Loaded()
{
  return loaded().IsComplete && !OpenCL::IsOfParent() ? &loaded().Functions : nullptr;
}

bool OpenCL::IsOfParent()
{
  return loaded().Forks != forksSinceLoad();
}

} // namespace RectifiedTransport
