// SPDX-License-Identifier: BSD-3-Clause
// A painting with its points and a brush: what the keys, the mouse and the self-driving mode do.
#ifndef Stippling_h
#define Stippling_h

#include "LiveTransport.h"
#include "Painting.h"
#include "ReadInk.h"

#include <memory>
#include <string>

class Stippling
{
public:
  struct Options
  {
    int NumberOfPoints = 16384;
    int Side = 1024;    // cells along the longer side
    float Wash = 0.1f;  // ink of a blank sheet
    std::string Device; // a part of an OpenCL device's name, or "any"; empty: the processor
  };

  explicit Stippling(const Options& options);

  Painting& GetPainting() { return *this->Canvas; }
  LiveTransport& GetTransport() { return *this->Transport; }
  double GetBrushRadius() const { return this->BrushRadius; }
  const std::string& GetMessage() const { return this->Message; }
  // Changes with each canvas of another size.
  int GetCanvasNumber() const { return this->CanvasNumber; }

  bool Open(const std::string& path); // false: GetMessage() tells why
  void StartOver();                   // the picture that was opened, or a blank sheet
  void Clear();
  void Invert();

  void SetNumberOfPoints(double count);
  void ScaleNumberOfPoints(double factor);
  void ScaleBrush(double factor);

  // The brush goes down, or on; in cells.
  void Paint(Place place, bool removes);
  void LiftBrush() { this->IsDown = false; }

  void Tell(const std::string& message) { this->Message = message; }

  // One update of the points. Returns whether they may have moved.
  bool Update();
  int GetMovingUpdates() const { return this->MovingUpdates; }    // in which they may have
  double GetUpdateSeconds() const { return this->UpdateSeconds; } // that the last one took

private:
  Options Initial;
  std::unique_ptr<Painting> Canvas;
  std::unique_ptr<LiveTransport> Transport;
  Ink Picture; // that was opened last
  int CanvasNumber = 0;
  double BrushRadius = 50.0;
  Place Brush{ 0.0, 0.0 };
  bool IsDown = false;
  int MovingUpdates = 0;
  double UpdateSeconds = 0.0;
  std::string Message;
};

#endif
