// SPDX-License-Identifier: BSD-3-Clause
// Summed-area tables on a device, with the additions of TableBuild.cxx in the same order: strips of
// fixed size, sums in order along each of their chains, and chains side by side. An item for each
// chain, or place.

#define RT_GROUP64 __attribute__((reqd_work_group_size(64, 1, 1)))

// A node's record is stored at once.
void storeRecord(__global double* node, double4 record)
{
  *(__global double4*)node = record;
}

// Loads a node's record at once; records are aligned to 32 bytes.
double4 loadRecord(__global const double* node)
{
  return *(__global const double4*)node;
}

#if RT_D == 2

// {f, f x_0} of the cells of a strip of a row, in eight lanes, about the strip's low face.
__kernel RT_GROUP64 void sumStrips(
  TableShape s, __global const double* values, __global double2* sums)
{
  const long row = get_global_id(0);
  const long strip = get_global_id(1);
  if (row >= s.Cells[1])
  {
    return;
  }
  const long start = strip * RT_STRIP_CELLS;
  const long count = min((long)RT_STRIP_CELLS, s.Cells[0] - start);
  __global const double* cells = values + row * s.Cells[0] + start;
  // Eight lanes, as the processor's vectors sum; they are added in pairs below.
  double sum[8];
  double moment[8];
  for (int lane = 0; lane < 8; ++lane)
  {
    sum[lane] = 0.0;
    moment[lane] = 0.0;
  }
  for (long i = 0; i < count; i += 8)
  {
    for (int lane = 0; lane < 8 && i + lane < count; ++lane)
    {
      const double value = cells[i + lane];
      sum[lane] += value;
      moment[lane] += value * ((double)(i + lane) + 0.5);
    }
  }
  sums[row * s.Strips + strip] =
    (double2)(((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7])),
      ((moment[0] + moment[1]) + (moment[2] + moment[3])) +
        ((moment[4] + moment[5]) + (moment[6] + moment[7])));
}

// Those of the strips before each, about the grid's low face.
__kernel RT_GROUP64 void sumBefore(
  TableShape s, __global double2* sums)
{
  const long row = get_global_id(0);
  if (row >= s.Cells[1])
  {
    return;
  }
  double sum = 0.0;
  double moment = 0.0;
  for (long strip = 0; strip < s.Strips; ++strip)
  {
    const double2 found = sums[row * s.Strips + strip];
    sums[row * s.Strips + strip] = (double2)(sum, moment);
    sum += found.x;
    // A strip's moment is about its own low face: moving it to the grid's adds the face's place
    // times the mass.
    moment += found.y + found.x * (double)(strip * RT_STRIP_CELLS);
  }
}

// The sums of each row up to each cell.
__kernel RT_GROUP64 void sumRows(
  TableShape s, __global const double* values, __global const double2* sums, __global double* nodes)
{
  const long row = get_global_id(0);
  const long strip = get_global_id(1);
  if (row >= s.Cells[1])
  {
    return;
  }
  const long start = strip * RT_STRIP_CELLS;
  const long end = min(start + RT_STRIP_CELLS, s.Cells[0]);
  double sum = sums[row * s.Strips + strip].x;
  double moment = sums[row * s.Strips + strip].y;
  double centre = (double)start + 0.5;
  const double across = (double)row + 0.5;
  // Node i + 1 of row + 1 holds the sum up to cell i of the row.
  __global double* node = nodes + (row + 1) * s.Stride1;
  for (long i = start; i < end; ++i)
  {
    const double value = values[row * s.Cells[0] + i];
    sum += value;
    moment += value * centre;
    centre += 1.0;
    storeRecord(node + 4 * (i + 1), (double4)(sum, moment, sum * across, sum));
  }
}

// Those of the rows up to each; column 0 and row 0 are zero.
__kernel RT_GROUP64 void sumColumns(
  TableShape s, __global double* nodes)
{
  const long i = get_global_id(0);
  if (i > s.Cells[0])
  {
    return;
  }
  double4 sum = 0.0;
  storeRecord(nodes + 4 * i, sum);
  for (long row = 1; row <= s.Cells[1]; ++row)
  {
    __global double* node = nodes + row * s.Stride1 + 4 * i;
    sum = i == 0 ? sum : sum + loadRecord(node);
    storeRecord(node, sum);
  }
}

#else

// {f, f x_1} of the columns of a strip of rows, in each slice.
__kernel RT_GROUP64 void sumStrips(
  TableShape s, __global const double* values, __global double* before)
{
  const long i = get_global_id(0);
  const long strip = get_global_id(1);
  const long k = get_global_id(2);
  if (i >= s.Cells[0])
  {
    return;
  }
  const long last = min((strip + 1) * RT_STRIP_ROWS, s.Cells[1]);
  double sum = 0.0;
  double moment = 0.0;
  for (long row = strip * RT_STRIP_ROWS; row < last; ++row)
  {
    const double value = values[(k * s.Cells[1] + row) * s.Cells[0] + i];
    sum += value;
    moment += value * ((double)row + 0.5);
  }
  storeRecord(before + ((k * s.Strips + strip) * s.Cells[0] + i) * 4,
    (double4)(sum, 0.0, moment, 0.0));
}

// Their sums along axis 0.
__kernel RT_GROUP64 void sumAlong(
  TableShape s, __global double* before)
{
  const long k = get_global_id(0);
  const long strip = get_global_id(1);
  if (k >= s.Cells[2])
  {
    return;
  }
  double sum = 0.0;
  double moment = 0.0;
  // Mass, moment along axis 0 and moment along axis 1, up to each column.
  double momentAcross = 0.0;
  for (long i = 0; i < s.Cells[0]; ++i)
  {
    __global double* column = before + ((k * s.Strips + strip) * s.Cells[0] + i) * 4;
    const double4 own = loadRecord(column);
    sum += own.s0;
    moment += own.s0 * ((double)i + 0.5);
    momentAcross += own.s2;
    storeRecord(column, (double4)(sum, moment, momentAcross, sum));
  }
}

// Those of the strips before each.
__kernel RT_GROUP64 void sumBefore(
  TableShape s, __global double* before)
{
  const long i = get_global_id(0);
  const long k = get_global_id(1);
  if (i >= s.Cells[0])
  {
    return;
  }
  double4 sum = 0.0;
  for (long strip = 0; strip < s.Strips; ++strip)
  {
    __global double* column = before + ((k * s.Strips + strip) * s.Cells[0] + i) * 4;
    const double4 own = loadRecord(column);
    storeRecord(column, sum);
    sum = sum + own;
  }
}

// The sums of each row up to each cell.
__kernel RT_GROUP64 void sumRows(
  TableShape s, __global const double* values, __global double* nodes)
{
  const long row = get_global_id(0);
  const long k = get_global_id(1);
  if (row >= s.Cells[1])
  {
    return;
  }
  double sum = 0.0;
  double moment = 0.0;
  double centre = 0.5;
  const double across = (double)row + 0.5;
  __global double* node = nodes + (k + 1) * s.Stride2 + (row + 1) * s.Stride1;
  storeRecord(node, (double4)(0.0));
  for (long i = 0; i < s.Cells[0]; ++i)
  {
    const double value = values[(k * s.Cells[1] + row) * s.Cells[0] + i];
    sum += value;
    moment += value * centre;
    centre += 1.0;
    storeRecord(node + 4 * (i + 1), (double4)(sum, moment, sum * across, sum));
  }
}

// Those of the rows of a slice up to each.
__kernel RT_GROUP64 void sumColumns(
  TableShape s, __global const double* before, __global double* nodes)
{
  const long i = get_global_id(0);
  const long strip = get_global_id(1);
  const long k = get_global_id(2);
  if (i >= s.Cells[0])
  {
    return;
  }
  // Starts from the sum of the strips before, so that strips are independent.
  double4 column = loadRecord(before + ((k * s.Strips + strip) * s.Cells[0] + i) * 4);
  const long last = min((strip + 1) * RT_STRIP_ROWS, s.Cells[1]);
  for (long row = strip * RT_STRIP_ROWS; row < last; ++row)
  {
    __global double* node = nodes + (k + 1) * s.Stride2 + (row + 1) * s.Stride1 + 4 * (i + 1);
    column = column + loadRecord(node);
    storeRecord(node, column);
  }
}

// Those of the slices up to each; plane 0, row 0 and column 0 are zero.
__kernel RT_GROUP64 void sumSlices(
  TableShape s, __global double* nodes)
{
  const long i = get_global_id(0);
  const long row = get_global_id(1);
  if (i > s.Cells[0])
  {
    return;
  }
  double4 sum = 0.0;
  __global double* first = nodes + row * s.Stride1 + 4 * i;
  storeRecord(first, sum);
  for (long k = 0; k < s.Cells[2]; ++k)
  {
    __global double* node = first + (k + 1) * s.Stride2;
    if (i > 0 && row > 0)
    {
      // The fourth entry is the mass until here; times the slice's centre it is the moment along
      // axis 2.
      sum = sum + loadRecord(node) * (double4)(1.0, 1.0, 1.0, (double)k + 0.5);
    }
    storeRecord(node, sum);
  }
}

#endif

// The nodes of a coarse level: every 2^shift-th one, and the last of an axis in any case.
__kernel RT_GROUP64 void copyLevel(
  TableShape s, __global const double* nodes, __global double* coarse, long offset, long stride1,
  long stride2, int shift)
{
  const long i = get_global_id(0);
  const long j = get_global_id(1);
  const long k = get_global_id(2);
  if (i >= ((s.Cells[0] - 1) >> shift) + 2)
  {
    return;
  }
  // The last node of an axis is at its end, whatever the level's spacing.
  const long from = 4 * min(i << shift, s.Cells[0]) + min(j << shift, s.Cells[1]) * s.Stride1 +
    (RT_D == 3 ? min(k << shift, s.Cells[2]) * s.Stride2 : 0);
  storeRecord(coarse + offset + k * stride2 + j * stride1 + 4 * i, loadRecord(nodes + from));
}
