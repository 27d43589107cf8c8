// SPDX-License-Identifier: BSD-3-Clause
// The points of a painting, transported anew whenever it or their number has changed:
// vtkTransportSampler on the painting's own memory, with seeds that keep their identity.
#ifndef LiveTransport_h
#define LiveTransport_h

#include "Painting.h"
#include "PairPoints.h"

#include <vtkNew.h>

#include <string>
#include <vector>

class vtkIdTypeArray;
class vtkImageData;
class vtkPoints;
class vtkPolyData;
class vtkTransportSampler;

class LiveTransport
{
public:
  static constexpr int MostPoints = 200000;
  static constexpr int GlideUpdates = 15;

  LiveTransport(Painting& painting, int numberOfPoints);
  ~LiveTransport();
  LiveTransport(const LiveTransport&) = delete;
  LiveTransport& operator=(const LiveTransport&) = delete;

  // The painting has to live until another one is set. The seeds are stretched to its size, and
  // glide on to even ones.
  void SetPainting(Painting& painting);

  // From 1 to MostPoints. The seeds become those of even blue noise of that number: each glides to
  // the nearest new place that is free, those that are too many vanish, new ones appear between.
  void SetNumberOfPoints(int count);
  int GetNumberOfPoints() const { return static_cast<int>(this->Targets.size()); }

  // Transports on an OpenCL device whose name contains a text, any if it is empty. Where that does
  // not serve, the processor goes on, and GetError tells so once.
  void UseDevice(const std::string& name);

  // Transports the points, if that changes them: `changed` is what the painting's Follows returned.
  bool Update(bool changed);

  // The points, with `PointId`, which a point keeps as long as it lives, and `Mass`.
  vtkPolyData* GetOutput();
  // Why there are none, if so.
  const std::string& GetError() const { return this->Error; }

private:
  void Rearrange(int count);
  void Glide();
  void WriteSeeds();

  vtkNew<vtkImageData> Density;
  vtkNew<vtkPolyData> Seeds;
  vtkNew<vtkPoints> SeedPoints;
  vtkNew<vtkIdTypeArray> Ids;
  vtkNew<vtkTransportSampler> Sampler;
  Points Now;     // the seeds
  Points Starts;  // of their way
  Points Targets; // and its ends
  double Size[2] = { 1.0, 1.0 };
  int Gliding = 0; // updates until the seeds are there
  long long NextId = 0;
  std::string Error;
  std::string Warning;
};

#endif
