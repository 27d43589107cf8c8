// SPDX-License-Identifier: BSD-3-Clause
// Two doubles that are computed as one, and complex numbers of them.
#ifndef RectifiedTransport_Lanes_h
#define RectifiedTransport_Lanes_h

namespace RectifiedTransport
{

// Every processor has registers of this size; longer vectors would be divided through memory.
using Lanes = double __attribute__((vector_size(16), may_alias));

// std::complex is for scalars, and its products may look for infinities.
struct ComplexLanes
{
  Lanes Real;
  Lanes Imaginary;
};

inline ComplexLanes operator+(const ComplexLanes& a, const ComplexLanes& b)
{
  return { a.Real + b.Real, a.Imaginary + b.Imaginary };
}
inline ComplexLanes operator-(const ComplexLanes& a, const ComplexLanes& b)
{
  return { a.Real - b.Real, a.Imaginary - b.Imaginary };
}
inline ComplexLanes operator*(const ComplexLanes& a, const ComplexLanes& b)
{
  return { a.Real * b.Real - a.Imaginary * b.Imaginary,
    a.Real * b.Imaginary + a.Imaginary * b.Real };
}
template <class Scalar> // Lanes or double
inline ComplexLanes operator*(const Scalar& a, const ComplexLanes& b)
{
  return { a * b.Real, a * b.Imaginary };
}
inline ComplexLanes timesI(const ComplexLanes& a)
{
  return { -a.Imaginary, a.Real };
}

// A complex number of each of four lines, read and written by halves: one half's intermediate
// values fit in the registers.
struct ComplexLines
{
  ComplexLanes operator[](int half) const { return { this->Real[half], this->Imaginary[half] }; }
  void Set(int half, const ComplexLanes& value)
  {
    this->Real[half] = value.Real;
    this->Imaginary[half] = value.Imaginary;
  }

  Lanes Real[2];
  Lanes Imaginary[2];
};

} // namespace RectifiedTransport

#endif
