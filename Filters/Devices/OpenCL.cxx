// SPDX-License-Identifier: BSD-3-Clause
#include "Devices/OpenCL.h"

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

// A function of the loader's library, which is never closed: drivers do not survive it.
void* find(const char* name)
{
#ifdef _WIN32
  static const HMODULE library = LoadLibraryA("OpenCL.dll");
  return library ? reinterpret_cast<void*>(GetProcAddress(library, name)) : nullptr;
#else
  static void* const library = dlopen("libOpenCL.so.1", RTLD_NOW | RTLD_LOCAL);
  return library ? dlsym(library, name) : nullptr;
#endif
}

// The functions of OpenCL, found once in this process; a child of fork() must not use them.
struct Loading
{
  OpenCL Functions;
  bool IsComplete = true;
  const int Forks = forksSinceLoad();

  Loading()
  {
#define RectifiedTransport_FIND(name)                                                              \
  this->Functions.name = reinterpret_cast<decltype(OpenCL::name)>(find(#name));                    \
  this->IsComplete = this->IsComplete && this->Functions.name
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
