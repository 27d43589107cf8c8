// SPDX-License-Identifier: BSD-3-Clause
// What the tests of the VTK classes share: checks, small images, and an ear for messages.
#ifndef SamplerTest_h
#define SamplerTest_h

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTransportSampler.h"

#include <cmath>
#include <cstdlib>
#include <functional>
#include <initializer_list>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

// Counts and reports what does not hold, and goes on.
class Checks
{
public:
  void That(bool holds, const char* what, int line, const std::string& detail = "")
  {
    if (!holds)
    {
      std::cout << "line " << line << ": " << what << " does not hold"
                << (detail.empty() ? "" : ": ") << detail << "\n";
      ++this->Failures;
    }
  }
  void Near(double a, double b, double tolerance, const char* what, int line)
  {
    std::ostringstream detail;
    detail << a << " and " << b << ", more than " << tolerance << " apart";
    this->That(std::abs(a - b) <= tolerance, what, line, detail.str());
  }
  int Result() const { return this->Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE; }

private:
  int Failures = 0;
};

// Makes all checks of a test; what its main function returns.
inline int runChecks(std::initializer_list<void (*)(Checks&)> all)
{
  Checks checks;
  for (const auto& check : all)
  {
    check(checks);
  }
  return checks.Result();
}

#define CHECK(checks, condition) (checks).That((condition), #condition, __LINE__)
#define CHECK_NEAR(checks, a, b, tolerance)                                                        \
  (checks).Near((a), (b), (tolerance), #a " == " #b, __LINE__)

// Hears the errors and warnings of an algorithm, which are then not printed, and keeps the
// executive quiet.
class Messages
{
public:
  explicit Messages(vtkAlgorithm* algorithm)
    : Algorithm(algorithm)
  {
    this->Ear->SetClientData(this);
    this->Ear->SetCallback([](vtkObject*, unsigned long event, void* self, void* text) {
      auto* messages = static_cast<Messages*>(self);
      (event == vtkCommand::ErrorEvent ? messages->Errors : messages->Warnings)
        .push_back(static_cast<const char*>(text));
    });
    algorithm->AddObserver(vtkCommand::ErrorEvent, this->Ear);
    algorithm->AddObserver(vtkCommand::WarningEvent, this->Ear);
    this->Deaf->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
    algorithm->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Deaf);
  }

  ~Messages()
  {
    this->Algorithm->RemoveObserver(this->Ear);
    this->Algorithm->GetExecutive()->RemoveObserver(this->Deaf);
  }
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;

  void Clear()
  {
    this->Errors.clear();
    this->Warnings.clear();
  }

  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;

private:
  vtkSmartPointer<vtkAlgorithm> Algorithm;
  vtkNew<vtkCallbackCommand> Ear;
  vtkNew<vtkCallbackCommand> Deaf;
};

inline bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

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

// Lets a filter make its tables anew from the same values: those of others take their place.
inline void forgetTables(vtkAlgorithm* filter, vtkDataObject* data)
{
  vtkDataArray* array = densityOf(data);
  const double value = array->GetComponent(0, 0);
  changeDensity(data);
  filter->Update();
  array->SetComponent(0, 0, value);
  array->Modified();
}

inline vtkDataArray* pointArray(vtkPolyData* data, const char* name)
{
  return data->GetPointData()->GetArray(name);
}

inline double fieldValue(vtkPolyData* data, const char* name)
{
  vtkDataArray* array = data->GetFieldData()->GetArray(name);
  return array ? array->GetComponent(0, 0) : std::nan("");
}

// A copy of the particles' coordinates, three a point.
inline std::vector<double> coordinates(vtkPolyData* data)
{
  std::vector<double> all(static_cast<std::size_t>(3 * data->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    data->GetPoint(i, all.data() + 3 * i);
  }
  return all;
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
