// SPDX-License-Identifier: BSD-3-Clause
// A density that one paints: ink from 0 to 1 in each of width x height cells, x fastest, y upwards.
#ifndef Painting_h
#define Painting_h

#include <cstddef>
#include <vector>

struct Place
{
  double X;
  double Y;
};

// What is shown follows what is painted by a quarter of the difference an update, so that nothing
// jumps, whether a dab is added or another picture opened. While nothing is painted at all, which
// is no density, the last picture stays shown.
class Painting
{
public:
  static constexpr float Follow = 0.25f;

  Painting(int width, int height, float ink);
  // Another picture's place is taken over, stretched to this size.
  Painting(int width, int height, const Painting& previous);

  int Width() const { return this->Columns; }
  int Height() const { return this->Rows; }
  // The values are at the same address as long as the painting lives.
  float* Shown() { return this->ShownInk.data(); }
  float Painted(int x, int y) const { return this->Ink[this->Index(x, y)]; }
  bool IsEmpty() const { return this->Inked == 0; }

  // A soft round brush along a line, in cells. Adds ink at its centre, or removes it (amount < 0).
  void Stroke(Place from, Place to, double radius, double amount);
  void Fill(float ink);
  void Invert();
  void Set(const std::vector<float>& ink); // one value a cell; what is not in [0,1] is clamped

  // One update of what is shown. Returns whether it changed.
  bool Follows();

private:
  struct Span // cells of a row in which shown and painted ink may differ
  {
    int Begin;
    int End;
  };

  std::size_t Index(int x, int y) const
  {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(this->Columns) +
      static_cast<std::size_t>(x);
  }
  void Dab(Place centre, double radius, double amount);
  void Put(int x, int y, float ink);
  void Touch(int y, int begin, int end);
  bool FollowsRow(int y);

  int Columns;
  int Rows;
  std::vector<float> Ink;
  std::vector<float> ShownInk;
  std::vector<Span> Differs; // a row each
  std::size_t Inked = 0;     // cells with ink
};

#endif
