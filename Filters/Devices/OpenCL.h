// SPDX-License-Identifier: BSD-3-Clause
// The functions of OpenCL 1.2 that are used, from the loader's library as it is at run time.
#ifndef RectifiedTransport_OpenCL_h
#define RectifiedTransport_OpenCL_h

#define CL_TARGET_OPENCL_VERSION 120
#define CL_USE_DEPRECATED_OPENCL_1_2_APIS
#include <CL/cl.h>

#include <cstddef>
#include <string>

namespace RectifiedTransport
{

struct OpenCL
{
#define RectifiedTransport_FUNCTIONS(each)                                                         \
  each(clGetPlatformIDs);                                                                          \
  each(clGetPlatformInfo);                                                                         \
  each(clGetDeviceIDs);                                                                            \
  each(clGetDeviceInfo);                                                                           \
  each(clCreateContext);                                                                           \
  each(clReleaseContext);                                                                          \
  each(clCreateCommandQueue);                                                                      \
  each(clReleaseCommandQueue);                                                                     \
  each(clCreateBuffer);                                                                            \
  each(clReleaseMemObject);                                                                        \
  each(clEnqueueWriteBuffer);                                                                      \
  each(clEnqueueReadBuffer);                                                                       \
  each(clCreateProgramWithSource);                                                                 \
  each(clBuildProgram);                                                                            \
  each(clGetProgramBuildInfo);                                                                     \
  each(clReleaseProgram);                                                                          \
  each(clCreateKernel);                                                                            \
  each(clReleaseKernel);                                                                           \
  each(clSetKernelArg);                                                                            \
  each(clEnqueueNDRangeKernel);                                                                    \
  each(clWaitForEvents);                                                                           \
  each(clReleaseEvent);                                                                            \
  each(clFlush);                                                                                   \
  each(clFinish)

#define RectifiedTransport_DECLARE(name) decltype(&::name) name = nullptr
  RectifiedTransport_FUNCTIONS(RectifiedTransport_DECLARE);
#undef RectifiedTransport_DECLARE

  // nullptr if there is no loader, one that lacks a function, or if IsOfParent.
  static const OpenCL* Loaded();
  // Whether the driver was loaded before the fork() that made this process. It is of no use then,
  // as its threads and its connection to the device are its parent's.
  static bool IsOfParent();
};

// A text that OpenCL gives by get(size, text, needed size).
template <class Get>
std::string infoText(const Get& get)
{
  std::size_t size = 0;
  get(0, nullptr, &size);
  std::string text(size, '\0');
  if (size > 0)
  {
    get(size, text.data(), nullptr);
  }
  return text.substr(0, text.find('\0'));
}

} // namespace RectifiedTransport

#endif
