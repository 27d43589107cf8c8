// SPDX-License-Identifier: BSD-3-Clause
// What the tests of the VTK classes share beside checks: small images and points, and the values of
// outputs.
#ifndef TestData_h
#define TestData_h

#include "Checks.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDensityAlgorithm.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTransportSampler.h"

#include <array>
#include <functional>
#include <numeric>

// An image of a numeric type: `values` on the points of `dimensions`, or on its cells. Values come
// from a function of the tuple's index.
template <class ArrayT = vtkDoubleArray>
vtkSmartPointer<vtkImageData> makeImage(int nx, int ny, int nz, bool cells,
  const std::function<double(vtkIdType)>& value, int components = 1)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(nx, ny, nz);
  vtkNew<ArrayT> array;
  array->SetName("Density");
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(cells ? image->GetNumberOfCells() : image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    array->SetComponent(i / components, static_cast<int>(i % components), value(i));
  }
  vtkDataSetAttributes* data = image->GetPointData();
  if (cells)
  {
    data = image->GetCellData();
  }
  data->SetScalars(array);
  return image;
}

// Uneven, positive, the same for every type that holds small integers.
inline double bumpy(vtkIdType i)
{
  return static_cast<double>(1 + (i * 37 + i * i % 11) % 23);
}

// Cells of width 1 with a corner at the origin.
inline vtkSmartPointer<vtkImageData> unitCells(int nx, int ny, int nz)
{
  return makeImage(nx + 1, ny + 1, nz + 1, true, bumpy);
}

// The same values on cells, and on the points half a spacing within them.
inline std::array<vtkSmartPointer<vtkImageData>, 2> makeCellsAndPoints()
{
  auto cells = unitCells(9, 7, 5);
  cells->SetOrigin(1.0, 2.0, 3.0);
  auto points = makeImage(9, 7, 5, false, bumpy);
  points->SetOrigin(1.25, 3.0, 3.625);
  for (vtkImageData* image : { cells.Get(), points.Get() })
  {
    image->SetSpacing(0.5, 2.0, 1.25);
  }
  return { cells, points };
}

inline vtkDataArray* densityOf(vtkDataObject* data)
{
  auto* image = vtkImageData::SafeDownCast(data);
  vtkDataArray* onPoints = image->GetPointData()->GetScalars();
  return onPoints ? onPoints : image->GetCellData()->GetScalars();
}

// Makes it another density.
inline void changeDensity(vtkDataObject* data)
{
  vtkDataArray* array = densityOf(data);
  const double value = array->GetComponent(0, 0);
  array->SetComponent(0, 0, value < 100.0 ? value + 1.0 : 1.0);
  array->Modified();
}

// Lets a filter build its tables anew from the same values, by building others in between.
inline void forgetTables(vtkAlgorithm* filter, vtkDataObject* data)
{
  vtkDataArray* array = densityOf(data);
  const double value = array->GetComponent(0, 0);
  changeDensity(data);
  filter->Update();
  array->SetComponent(0, 0, value);
  array->Modified();
}

// Updates a filter. Returns whether that built tables.
inline bool builds(vtkDensityAlgorithm* filter)
{
  const vtkMTimeType before = filter->GetTableBuildTime();
  filter->Update();
  return filter->GetTableBuildTime() > before;
}

// The errors of the settings that all flows have.
template <class Filter>
void expectFlowErrors(ErrorTest& test, Filter* filter, int line)
{
  const int steps = filter->GetNumberOfSteps();
  filter->SetNumberOfSteps(-1);
  test.Expect("NumberOfSteps is -1; it must be from 1 to 10000, or 0", line);
  filter->SetNumberOfSteps(steps);
  for (const double tolerance : { 0.0, -0.02, 1.5, std::nan("") })
  {
    filter->SetAreaTolerance(tolerance);
    test.Expect("; it must be above 0 and at most 1", line);
  }
  filter->SetAreaTolerance(0.02);
  filter->SetThreading(9);
  test.Expect("Threading is 9; it must be 0 (Auto)", line);
  filter->SetThreadingToAuto();
}

inline vtkDataArray* pointArray(vtkPolyData* data, const char* name)
{
  return data->GetPointData()->GetArray(name);
}

inline double fieldValue(vtkDataObject* data, const char* name)
{
  vtkDataArray* array = data->GetFieldData()->GetArray(name);
  return array && array->GetNumberOfTuples() == 1 ? array->GetComponent(0, 0) : std::nan("");
}

using Values = std::vector<double>;

inline Values arrayValues(vtkDataArray* array)
{
  Values values;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      values.push_back(array->GetComponent(i, c));
    }
  }
  return values;
}

// An array of an image, of its points or its cells; it is empty if it is on both or on none.
inline Values imageValues(vtkImageData* image, const char* name)
{
  vtkDataArray* onPoints = image->GetPointData()->GetArray(name);
  vtkDataArray* onCells = image->GetCellData()->GetArray(name);
  return onPoints && onCells ? Values() : arrayValues(onPoints ? onPoints : onCells);
}

inline double sumOf(const Values& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// A copy of the points' coordinates, three a point.
inline Values coordinates(vtkPointSet* data)
{
  Values all(static_cast<std::size_t>(3 * data->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    data->GetPoint(i, all.data() + 3 * i);
  }
  return all;
}

inline vtkSmartPointer<vtkPolyData> makePoints(const Values& x, bool single = false)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(single ? VTK_FLOAT : VTK_DOUBLE);
  for (std::size_t i = 0; i < x.size(); i += 3)
  {
    points->InsertNextPoint(x.data() + i);
  }
  data->SetPoints(points);
  return data;
}

inline std::vector<double> sampleCoordinates(vtkTransportSampler* sampler)
{
  sampler->Update();
  return coordinates(sampler->GetOutput());
}

// The coordinates of a default sampler with few particles on an image.
inline std::vector<double> samplePoints(vtkImageData* image, vtkIdType count = 500)
{
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->SetNumberOfParticles(count);
  return sampleCoordinates(sampler);
}

inline double largestDifference(const std::vector<double>& a, const std::vector<double>& b)
{
  if (a.size() != b.size() || a.empty())
  {
    return HUGE_VAL;
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const double difference = std::abs(a[i] - b[i]);
    largest = difference <= largest ? largest : difference;
  }
  return largest;
}

#endif
