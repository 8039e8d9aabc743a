// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the tests of vtkMeshOptimizeFilter share: the choice of the algorithm.
 */
#ifndef MeshOptimizeFilterTesting_h
#define MeshOptimizeFilterTesting_h

#include "FilterTesting.h"

#include "vtkMeshOptimizeFilter.h"

namespace Testing
{

/**
 * A filter that runs one of the algorithms.
 */
class OptimizeFilter : public vtkNew<vtkMeshOptimizeFilter>
{
public:
  explicit OptimizeFilter(int algorithm) { this->Get()->SetAlgorithm(algorithm); }
};

/**
 * Cases of a suite that derives from this run with each algorithm, which is GetParam(), if the
 * suite is instantiated by TEST_BOTH_ALGORITHMS(suite).
 */
class BothAlgorithms : public testing::TestWithParam<int>
{
};

inline std::string NameOfAlgorithm(const testing::TestParamInfo<int>& info)
{
  return info.param == vtkMeshOptimizeFilter::Paper1996 ? "Paper1996" : "WorstFirst";
}

#define TEST_BOTH_ALGORITHMS(suite)                                                       \
  INSTANTIATE_TEST_SUITE_P(Both, suite,                                                   \
    testing::Values(vtkMeshOptimizeFilter::Paper1996, vtkMeshOptimizeFilter::WorstFirst), \
    Testing::NameOfAlgorithm)

/**
 * A number that the filter leaves in the field data; -1e9 if it does not.
 */
inline double Figure(vtkUnstructuredGrid* grid, const char* name)
{
  vtkDataArray* array = grid->GetFieldData()->GetArray(name);
  return array ? array->GetComponent(0, 0) : -1e9;
}

/**
 * The figures in the field data are those of the filter, and of the output.
 */
inline void CheckFieldData(vtkMeshOptimizeFilter* filter)
{
  vtkUnstructuredGrid* output = filter->GetOutput();
  vtkDataArray* quality = output->GetCellData()->GetArray("MeshQuality");
  ASSERT_TRUE(quality);
  EXPECT_EQ(quality->GetDataType(), VTK_DOUBLE);
  EXPECT_EQ(MinimumOf(quality), filter->GetWorstQualityAfter());
  EXPECT_GE(filter->GetWorstQualityAfter(), filter->GetWorstQualityBefore());
  EXPECT_LE(filter->GetWorstQualityAfter(), filter->GetQualityBound());
  double sum = 0.0;
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    sum += quality->GetComponent(c, 0);
  }
  EXPECT_NEAR(sum / output->GetNumberOfCells(), filter->GetMeanQualityAfter(), 1e-12);
  EXPECT_EQ(Figure(output, "WorstQualityBefore"), filter->GetWorstQualityBefore());
  EXPECT_EQ(Figure(output, "WorstQualityAfter"), filter->GetWorstQualityAfter());
  EXPECT_EQ(Figure(output, "MeanQualityBefore"), filter->GetMeanQualityBefore());
  EXPECT_EQ(Figure(output, "MeanQualityAfter"), filter->GetMeanQualityAfter());
  EXPECT_EQ(Figure(output, "QualityBound"), filter->GetQualityBound());
  EXPECT_EQ(Figure(output, "NumberOfCappedCells"), filter->GetNumberOfCappedCells());
  EXPECT_EQ(Figure(output, "NumberOfOperations"), filter->GetNumberOfOperations());
  EXPECT_EQ(output->GetFieldData()->GetAbstractArray("StopReason")->GetVariantValue(0).ToString(),
    filter->GetStopReasonAsString());
  EXPECT_NE(filter->GetStopReason(), vtkMeshOptimizeFilter::NotRun);
  EXPECT_GT(filter->GetOptimizeSeconds(), 0.0);
}

/**
 * Every kind of change is off: the filter measures only.
 */
inline void ChangeNothing(vtkMeshOptimizeFilter* filter)
{
  filter->MoveNodesOff();
  filter->ReconnectOff();
  filter->InsertNodesOff();
  filter->RemoveNodesOff();
}

using Prepare = std::function<void(vtkMeshOptimizeFilter*)>;

/**
 * ExpectError() of FilterTesting.h; also nothing in the history and the figures, and another filter
 * works with a good mesh.
 */
inline void ExpectOptimizeError(
  int algorithm, vtkDataObject* input, const Texts& words, const Prepare& prepare)
{
  OptimizeFilter filter(algorithm);
  ExpectError(filter.Get(), input, words, prepare);
  EXPECT_EQ(vtkTable::SafeDownCast(filter->GetOutputDataObject(1))->GetNumberOfRows(), 0);
  EXPECT_EQ(filter->GetStopReason(), vtkMeshOptimizeFilter::NotRun);
  EXPECT_EQ(filter->GetWorstQualityAfter(), 0.0);

  OptimizeFilter healthy(algorithm);
  healthy->SetInputDataObject(MakeBox(2, 0.2));
  healthy->Update();
  EXPECT_GT(healthy->GetOutput()->GetNumberOfCells(), 0);
}

} // namespace Testing

#endif
