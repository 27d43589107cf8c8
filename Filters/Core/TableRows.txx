// SPDX-License-Identifier: BSD-3-Clause
// One row of cells added to the summed-area tables (paper, Algorithm 2). Included by
// FlowKernels.txx.

using Vector4 = double __attribute__((vector_size(32)));

// Tables that do not fit into the caches are written past them: nobody reads them back before the
// caches have turned over.
template <bool Stream>
RT_INLINE void storeNode(double* node, Vector4 value)
{
#if defined(__SSE2__)
  if constexpr (Stream)
  {
    _mm_stream_pd(node, __m128d{ value[0], value[1] });
    _mm_stream_pd(node + 2, __m128d{ value[2], value[3] });
    return;
  }
#endif
  std::memcpy(node, &value, sizeof(value));
}

RT_INLINE Vector4 loadNode(const double* node)
{
  Vector4 value;
  std::memcpy(&value, node, sizeof(value));
  return value;
}

template <bool Stream>
RT_INLINE void addRow2D(const TableRow2D& row)
{
  double sum = row.Prefix[0];
  double moment = row.Prefix[1];
  double centre = static_cast<double>(row.First) + 0.5;
  for (std::int64_t i = 0; i < row.Count; ++i)
  {
    const double value = row.Values[i] * row.Scale;
    sum += value;
    moment += value * centre;
    centre += 1.0;
    const Vector4 node = loadNode(row.Running + 4 * i) + Vector4{ sum, moment, sum * row.Centre, sum };
    std::memcpy(row.Running + 4 * i, &node, sizeof(node));
    storeNode<Stream>(row.Nodes + 4 * i, node);
  }
}

void addTableRow2D(const TableRow2D& row)
{
  row.Stream ? addRow2D<true>(row) : addRow2D<false>(row);
}

template <bool Stream>
RT_INLINE void addRow3D(const TableRow3D& row)
{
  double sum = 0.0;
  double moment = 0.0;
  double centre = 0.5;
  const Vector4 lift = { 1.0, 1.0, 1.0, row.Centre[1] };
  for (std::int64_t i = 0; i < row.Count; ++i)
  {
    const double value = row.Values[i] * row.Scale;
    sum += value;
    moment += value * centre;
    centre += 1.0;
    const Vector4 column =
      loadNode(row.Columns + 4 * i) + Vector4{ sum, moment, sum * row.Centre[0], sum };
    std::memcpy(row.Columns + 4 * i, &column, sizeof(column));
    const Vector4 node = loadNode(row.Running + 4 * i) + column * lift;
    std::memcpy(row.Running + 4 * i, &node, sizeof(node));
    storeNode<Stream>(row.Nodes + 4 * i, node);
  }
}

void addTableRow3D(const TableRow3D& row)
{
  row.Stream ? addRow3D<true>(row) : addRow3D<false>(row);
}
