// SPDX-License-Identifier: BSD-3-Clause
// Reads runs of tuples of a data array as densities, fast for every numeric type.
#ifndef RectifiedTransport_DensityReader_h
#define RectifiedTransport_DensityReader_h

#include "Bridge/VTKCompatibility.h"

#include "vtkType.h"

#include <memory>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// Which numbers of a tuple make its density.
struct TupleReading
{
  int Component = -1;  // an index, or -1 for luminance
  bool Invert = false; // white - value
  double White = 0.0;  // for Invert and alpha
};

class DensityReader
{
public:
  virtual ~DensityReader() = default;
  virtual void Read(
    vtkIdType first, vtkIdType count, const TupleReading& reading, double* values) const = 0;
  // The largest finite value of a component, or of all (-1), among the tuples for which `blank`
  // (may be null) has none of the bits of `mask`; minus infinity if there is none.
  virtual double Maximum(vtkIdType first, vtkIdType count, int component,
    const unsigned char* blank, unsigned char mask) const = 0;
};

std::unique_ptr<DensityReader> makeDensityReader(vtkDataArray* array);

} // namespace RectifiedTransport

#endif
