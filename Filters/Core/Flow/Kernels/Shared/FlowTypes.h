// SPDX-License-Identifier: BSD-3-Clause
// What a processor passes to the kernels of a device: numbers of 8 bytes alone, so that no compiler
// pads.
#ifndef RectifiedTransport_FlowTypes_h
#define RectifiedTransport_FlowTypes_h

#ifdef __cplusplus
using Int64 = std::int64_t;
#endif

#define RT_MAXIMUM_LEVELS 16

// Forwards, from a hand-over on all particles have these times in common after step k of N:
// RT_COMMON_START + (1 - RT_COMMON_START) sin^2(pi k / 2N).
#define RT_COMMON_START 0.25

// The tables (TableView.h), whose finest level is a buffer of its own, and what is computed in
// them (FlowJob).
typedef struct
{
  Int64 LevelCount;
  Int64 Offset[RT_MAXIMUM_LEVELS];    // of coarse levels in their buffer, in doubles
  Int64 Stride[RT_MAXIMUM_LEVELS][3]; // in doubles
  Int64 Cells[3];
  Int64 EvenLevels[3];
  Int64 WordsPerRow;
  Int64 HasEmptyCells; // else there are no bits of cells
  Int64 Backward;
  double Size[3];
  double Centroid[3];
  double VoidMass;
  double Largest;
  double InverseRatio; // 1 / CoarseRatio
  double Widest;       // width of a cell of the coarsest level
} FlowInput;

// A level of a flow map (FlowMapView.h).
typedef struct
{
  Int64 HandOver;
  Int64 FirstRecord; // where its records begin, in floats
  Int64 FirstCell;   // and the marks of its cells
  Int64 Cells[3];
  double TimeLeft;
  double Size[3];
  double Layer[3];
  double Length[3];
  double InverseSpacing[3];
} MapLevelInput;

// In C++ that of FlowKernels.h.
#ifndef __cplusplus
typedef struct
{
  double Time;
  double Length;
  double Predictor[3];
  double Corrector[3];
} StepWeights;
#endif

// The counts of a pass over particles, or over a group of RT_GROUP of them.
#define RT_GROUP 256
typedef struct
{
  Int64 Evaluations;
  Int64 Unresolved;
} PassCounts;

// The points of a lattice.
typedef struct
{
  Int64 Cells[3];
  double Place[3]; // in a cell
  double Size[3];  // of the box
} LatticeInput;

// What the nodes of a level of a flow map take from a coarser one, or from scratch.
typedef struct
{
  Int64 First; // number of the first of their weights
  Int64 Steps;
  double Begin; // backward: the times between which these lead
  double End;
} NodeSteps;

// The cells of tables and the strides of their nodes, in doubles. Sums are taken over strips, as in
// TableBuild.cxx.
#define RT_STRIP_CELLS 256 // along axis 0, in 2D
#define RT_STRIP_ROWS 32   // along axis 1, in 3D
typedef struct
{
  Int64 Cells[3];
  Int64 Strips;
  Int64 Stride1;
  Int64 Stride2;
} TableShape;

#endif
