// SPDX-License-Identifier: BSD-3-Clause
// vtkTetGenFilter: the same bits, threads, silence, progress and abort.
#include "TetGenFilterTesting.h"

#include <cstdio>
#include <cstdlib>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

using namespace Testing;

namespace
{

TEST(TetGenFilterRun, SameBitsOnceMoreAndInOtherThreads)
{
  Surface box = MakeBoxSurface(6);
  const auto refine = [](vtkTetGenFilter* f) { f->SetMaximumVolume(2e-4); };
  Grid first = Fill(box, refine);
  std::rand(); // TetGen uses rand(): the state of the application must not matter
  EXPECT_TRUE(SameGrid(first, Fill(box, refine)));

  Grid grids[3];
  Surface boxes[3];
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i)
  {
    grids[i] = Grid::New();
    boxes[i] = MakeBoxSurface(6);
    threads.emplace_back(
      [&, i]()
      {
        vtkNew<vtkTetGenFilter> filter;
        filter->SetInputData(boxes[i]);
        refine(filter);
        filter->Update();
        grids[i]->ShallowCopy(filter->GetOutput());
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (const Grid& grid : grids)
  {
    EXPECT_TRUE(SameGrid(first, grid));
  }
}

/**
 * Nothing on stdout or stderr, and no process left behind.
 */
TEST(TetGenFilterRun, IsQuiet)
{
  std::fflush(stdout);
  std::FILE* file = std::tmpfile();
  const int out = ::dup(STDOUT_FILENO), err = ::dup(STDERR_FILENO);
  std::printf("written before");
  ::dup2(::fileno(file), STDOUT_FILENO);
  ::dup2(::fileno(file), STDERR_FILENO);
  vtkNew<vtkTetGenFilter> filter;
  Messages messages(filter);
  filter->SetInputData(MakeBoxSurface(3));
  filter->Update();
  Soup crossing;
  crossing.AddBox({ { 0, 0, 0 } }, { { 1, 1, 1 } }, 1);
  crossing.AddBox({ { 0.3, 0.3, 0.3 } }, { { 1.3, 1.3, 1.3 } }, 1);
  filter->SetInputData(crossing.Make());
  filter->Update();
  std::fflush(stdout);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  EXPECT_EQ(std::ftell(file), static_cast<long>(std::strlen("written before"))); // once, not twice
  EXPECT_EQ(messages.Errors.size(), 1u);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1); // no child
  std::fclose(file);
  ::close(out);
  ::close(err);
}

TEST(TetGenFilterRun, ProgressNeverFallsAndAnAbortLeavesNothing)
{
  Surface box = MakeBoxSurface(10);
  vtkNew<vtkTetGenFilter> filter;
  Messages messages(filter);
  filter->SetInputData(box);
  filter->SetMaximumVolume(2e-6);
  struct Seen
  {
    double Last = 0.0;
    bool Falls = false;
    bool Stop = false;
    int Phases = 0;
    std::string Text;
  } seen;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&seen);
  observer->SetCallback(
    [](vtkObject* caller, unsigned long, void* self, void* fraction)
    {
      auto mine = static_cast<Seen*>(self);
      auto algorithm = static_cast<vtkTetGenFilter*>(caller);
      const double now = *static_cast<double*>(fraction);
      mine->Falls |= now < mine->Last;
      mine->Last = now;
      const char* text = algorithm->GetProgressText();
      mine->Phases += text && mine->Text != text;
      mine->Text = text ? text : "";
      if (mine->Stop && mine->Text == "Refining")
      {
        algorithm->SetAbortExecute(1);
      }
    });
  filter->AddObserver(vtkCommand::ProgressEvent, observer);
  seen.Stop = true;
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_EQ(seen.Text, "Refining");
  EXPECT_FALSE(seen.Falls);
  EXPECT_GE(seen.Phases, 3);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);

  seen = Seen();
  filter->SetAbortExecute(0);
  filter->SetMaximumVolume(1e-3);
  filter->Update();
  EXPECT_FALSE(seen.Falls);
  EXPECT_GE(seen.Phases, 3);
  EXPECT_EQ(seen.Last, 1.0);
  EXPECT_GT(filter->GetOutput()->GetNumberOfCells(), 0);
}

} // namespace
