// SPDX-License-Identifier: BSD-3-Clause
// What the tests of vtkTransportQuality share.
#ifndef QualityTest_h
#define QualityTest_h

#include "WarpTest.h"

#include "vtkTable.h"
#include "vtkTransportQuality.h"
#include "vtkVariant.h"

// The figures; none if there is no row of them.
inline Values runQuality(vtkTransportQuality* quality)
{
  quality->Update();
  vtkTable* table = quality->GetOutput();
  Values figures;
  for (vtkIdType i = 0; table->GetNumberOfRows() == 1 && i < table->GetNumberOfColumns(); ++i)
  {
    figures.push_back(table->GetValue(0, i).ToDouble());
  }
  return figures;
}

#endif
