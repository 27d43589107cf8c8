// SPDX-License-Identifier: BSD-3-Clause
// Records of tables (doubles) and of flow maps (floats), in as many registers as the instruction
// set needs. Vector types wider than the hardware's are legal, but compilers spill them. Included
// by FlowKernels.txx.

#if defined(__AVX512F__)
constexpr int widestRegister = 64; // bytes
#elif defined(__AVX__)
constexpr int widestRegister = 32;
#else
constexpr int widestRegister = 16;
#endif

// The type of a register of Bytes bytes that holds numbers of type Value.
template <class Value, int Bytes>
struct RegisterOf
{
  // GCC ignores the attribute where `using` names a type that depends on arguments.
  typedef Value Type __attribute__((vector_size(Bytes)));
};

// N Values in as few registers as hold them. Arithmetic is element by element, so that how they are
// cut in registers changes no bits.
template <int N, class Value = double>
struct Vector
{
  static constexpr int Size = static_cast<int>(sizeof(Value));
  static constexpr int Lanes =
    N * Size < widestRegister ? N : widestRegister / Size; // values a register
  static constexpr int Registers = N / Lanes;
  using Register = typename RegisterOf<Value, Lanes * Size>::Type;

  Register Part[Registers];

  RT_INLINE Value operator[](int lane) const { return this->Part[lane / Lanes][lane % Lanes]; }
};

// A record of a table in 2D and 3D, and the two records of a pair of neighbouring nodes.
using Vector4 = Vector<4>;
using Vector8 = Vector<8>;

// The operators work element by element. Loops over registers have a constant length and are
// unrolled, so that vectors stay in registers.
template <int N, class Value>
RT_INLINE Vector<N, Value> operator+(const Vector<N, Value>& a, const Vector<N, Value>& b)
{
  Vector<N, Value> sum;
#pragma GCC unroll 4
  for (int i = 0; i < Vector<N, Value>::Registers; ++i)
  {
    sum.Part[i] = a.Part[i] + b.Part[i];
  }
  return sum;
}

template <int N, class Value>
RT_INLINE Vector<N, Value> operator-(const Vector<N, Value>& a, const Vector<N, Value>& b)
{
  Vector<N, Value> difference;
#pragma GCC unroll 4
  for (int i = 0; i < Vector<N, Value>::Registers; ++i)
  {
    difference.Part[i] = a.Part[i] - b.Part[i];
  }
  return difference;
}

template <int N, class Value>
RT_INLINE Vector<N, Value> operator*(const Vector<N, Value>& a, const Vector<N, Value>& b)
{
  Vector<N, Value> product;
#pragma GCC unroll 4
  for (int i = 0; i < Vector<N, Value>::Registers; ++i)
  {
    product.Part[i] = a.Part[i] * b.Part[i];
  }
  return product;
}

// The product with a scalar, which the compiler broadcasts to all elements.
template <int N, class Value>
RT_INLINE Vector<N, Value> operator*(const Vector<N, Value>& a, Value b)
{
  Vector<N, Value> product;
#pragma GCC unroll 4
  for (int i = 0; i < Vector<N, Value>::Registers; ++i)
  {
    product.Part[i] = a.Part[i] * b;
  }
  return product;
}

// Loads from memory of any alignment.
template <int N, class Value>
RT_INLINE Vector<N, Value> loadVector(const Value* from)
{
  using Loaded = Vector<N, Value>;
  Loaded vector;
#pragma GCC unroll 4
  for (int i = 0; i < Loaded::Registers; ++i)
  {
    std::memcpy(&vector.Part[i], from + i * Loaded::Lanes, sizeof(typename Loaded::Register));
  }
  return vector;
}

// Four times `value`.
RT_INLINE Vector4 fillVector(double value)
{
  Vector4 vector;
#pragma GCC unroll 4
  for (int i = 0; i < Vector4::Registers; ++i)
  {
    vector.Part[i] = Vector4::Register{} + value;
  }
  return vector;
}

// A constant: compilers do not make one of a blend of constants.
RT_INLINE Vector4 makeVector(double a, double b, double c, double d)
{
  using Register = Vector4::Register;
#if defined(__AVX__)
  return { { Register{ a, b, c, d } } };
#else
  return { { Register{ a, b }, Register{ c, d } } };
#endif
}

// {value, value, value, value}, but `other` in lane Lane.
template <int Lane>
RT_INLINE Vector4 fillVector(double value, double other)
{
#if defined(__AVX__)
  return { { _mm256_blend_pd(_mm256_set1_pd(value), _mm256_set1_pd(other), 1 << Lane) } };
#else
  Vector4 vector = fillVector(value);
  vector.Part[Lane / Vector4::Lanes][Lane % Vector4::Lanes] = other;
  return vector;
#endif
}

// The records of a pair of nodes, `first` in the low half.
RT_INLINE Vector8 joinVectors(const Vector4& first, const Vector4& second)
{
#if defined(__AVX512F__)
  // The masked forms, all lanes taken: GCC 12's headers make it warn of the others.
  constexpr __mmask8 all = 0xff;
  return { { _mm512_maskz_insertf64x4(
    all, _mm512_castpd256_pd512(first.Part[0]), second.Part[0], 1) } };
#else
  Vector8 vector;
#pragma GCC unroll 2
  for (int i = 0; i < Vector4::Registers; ++i)
  {
    vector.Part[i] = first.Part[i];
    vector.Part[Vector4::Registers + i] = second.Part[i];
  }
  return vector;
#endif
}

// The sum of a vector's halves.
RT_INLINE Vector4 addHalves(const Vector8& vector)
{
#if defined(__AVX512F__)
  constexpr __mmask8 all = 0xff;
  return { { _mm512_maskz_extractf64x4_pd(all, vector.Part[0], 0) +
    _mm512_maskz_extractf64x4_pd(all, vector.Part[0], 1) } };
#else
  Vector4 sum;
#pragma GCC unroll 2
  for (int i = 0; i < Vector4::Registers; ++i)
  {
    sum.Part[i] = vector.Part[i] + vector.Part[Vector4::Registers + i];
  }
  return sum;
#endif
}
