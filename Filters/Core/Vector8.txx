// SPDX-License-Identifier: BSD-3-Clause
// Eight doubles, two node records, in as many registers as the instruction set needs. Wider vector
// types than the hardware's own are legal, but compilers spill them. Included by FlowKernels.txx.

#if defined(__AVX512F__)
constexpr int registerLanes = 8;
#elif defined(__AVX__)
constexpr int registerLanes = 4;
#else
constexpr int registerLanes = 2;
#endif
constexpr int registerCount = 8 / registerLanes;

using Register = double __attribute__((vector_size(registerLanes * sizeof(double))));

struct Vector8
{
  Register Part[registerCount];

  RT_INLINE double operator[](int lane) const
  {
    return this->Part[lane / registerLanes][lane % registerLanes];
  }
};

RT_INLINE Vector8 operator+(const Vector8& a, const Vector8& b)
{
  Vector8 sum;
#pragma GCC unroll 4
  for (int i = 0; i < registerCount; ++i)
  {
    sum.Part[i] = a.Part[i] + b.Part[i];
  }
  return sum;
}

RT_INLINE Vector8 operator-(const Vector8& a, const Vector8& b)
{
  Vector8 difference;
#pragma GCC unroll 4
  for (int i = 0; i < registerCount; ++i)
  {
    difference.Part[i] = a.Part[i] - b.Part[i];
  }
  return difference;
}

RT_INLINE Vector8 operator*(const Vector8& a, const Vector8& b)
{
  Vector8 product;
#pragma GCC unroll 4
  for (int i = 0; i < registerCount; ++i)
  {
    product.Part[i] = a.Part[i] * b.Part[i];
  }
  return product;
}

RT_INLINE Vector8 operator*(const Vector8& a, double b)
{
  Vector8 product;
#pragma GCC unroll 4
  for (int i = 0; i < registerCount; ++i)
  {
    product.Part[i] = a.Part[i] * b;
  }
  return product;
}

RT_INLINE Vector8 loadVector(const double* from)
{
  Vector8 vector;
#pragma GCC unroll 4
  for (int i = 0; i < registerCount; ++i)
  {
    std::memcpy(&vector.Part[i], from + i * registerLanes, sizeof(Register));
  }
  return vector;
}

// Four times `first`, four times `second`.
RT_INLINE Vector8 fillVector(double first, double second)
{
  Vector8 vector;
#if defined(__AVX512F__)
  vector.Part[0] = Register{ first, first, first, first, second, second, second, second };
#else
#pragma GCC unroll 4
  for (int i = 0; i < registerCount; ++i)
  {
    vector.Part[i] = Register{} + (i < registerCount / 2 ? first : second);
  }
#endif
  return vector;
}
