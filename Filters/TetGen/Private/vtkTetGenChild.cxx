// SPDX-License-Identifier: BSD-3-Clause
// TetGen runs in a process of its own, which a crash or an abort may end. Two pipes lead back from
// it: what it prints, which tells the phase, and the mesh.
#include "vtkTetGenChild.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <mutex>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

namespace vtkTetGenBridge
{

namespace
{

// As long may an abort have to wait.
constexpr int PollMilliseconds = 100;
// Enough of what TetGen prints to find faults in it; the pipe is read to its end all the same.
constexpr std::size_t KeptText = std::size_t(4) << 20;

/**
 * The header of the child's message, followed by the three arrays. The magic number marks a
 * complete message. Both ends are one program: bytes go as they are in memory.
 */
struct Header
{
  std::uint64_t Magic = 0;
  std::int64_t Error = 0;
  std::uint64_t Points = 0, Tetrahedra = 0, Regions = 0; // lengths of the arrays
};
constexpr std::uint64_t HeaderMagic = 0x7465747261686564ULL;

class Pipe
{
public:
  Pipe()
  {
    if (::pipe(this->Ends) != 0)
    {
      this->Ends[0] = this->Ends[1] = -1;
      return;
    }
    for (const int end : this->Ends)
    {
      // Other programs that this process starts in the meantime must not hold the pipe open.
      ::fcntl(end, F_SETFD, FD_CLOEXEC);
    }
  }
  ~Pipe()
  {
    this->Close(0);
    this->Close(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  bool IsOpen() const { return this->Ends[0] >= 0; }
  int ReadEnd() const { return this->Ends[0]; }
  int WriteEnd() const { return this->Ends[1]; }
  void Close(int end)
  {
    if (this->Ends[end] >= 0)
    {
      ::close(this->Ends[end]);
      this->Ends[end] = -1;
    }
  }

private:
  int Ends[2];
};

//------------------------------------------------------------------------------
/**
 * A pipe takes as much as it has room for: the rest goes with the next calls.
 */
bool WriteAll(int file, const void* data, std::size_t bytes)
{
  auto from = static_cast<const char*>(data);
  while (bytes > 0)
  {
    const ssize_t n = ::write(file, from, bytes);
    // A signal of the application came in between, which is no fault.
    if (n < 0 && errno == EINTR)
    {
      continue;
    }
    if (n <= 0)
    {
      return false;
    }
    from += n;
    bytes -= static_cast<std::size_t>(n);
  }
  return true;
}

template <typename T>
bool WriteArray(int file, const std::vector<T>& array)
{
  return WriteAll(file, array.data(), array.size() * sizeof(T));
}

/**
 * The life of the child. It ends with _exit(): destructors and exit handlers belong to the parent.
 */
[[noreturn]] void BeChild(const Job& job, int textFile, int meshFile)
{
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL); // die with the application if that is killed
#endif
  // A crash of the child becomes an error message of the filter: no handler of the application, no
  // core dump.
  for (const int deadly : { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGINT })
  {
    std::signal(deadly, SIG_DFL);
  }
  const struct rlimit none = { 0, 0 };
  ::setrlimit(RLIMIT_CORE, &none);
  ::dup2(textFile, STDOUT_FILENO);
  ::dup2(textFile, STDERR_FILENO);
  // TetGen's output must be flushed before a crash: line by line. This can be set only before a
  // stream is first used, and the application may have printed already: the stream is opened again.
  if (std::freopen("/dev/null", "w", stdout))
  {
    ::dup2(textFile, ::fileno(stdout));
    std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  }

  int status = 1;
  try
  {
    Mesh mesh;
    Header header;
    header.Magic = HeaderMagic;
    header.Error = RunTetGen(job, mesh);
    header.Points = mesh.Points.size();
    header.Tetrahedra = mesh.Tetrahedra.size();
    header.Regions = mesh.Regions.size();
    std::fflush(stdout);
    const bool sent = WriteAll(meshFile, &header, sizeof header) &&
      WriteArray(meshFile, mesh.Points) && WriteArray(meshFile, mesh.Tetrahedra) &&
      WriteArray(meshFile, mesh.Regions);
    status = sent ? 0 : 1;
  }
  catch (const std::exception& e)
  {
    std::fprintf(stderr, "%s\n", e.what());
  }
  ::_exit(status);
}

//------------------------------------------------------------------------------
/**
 * The progress at which TetGen begins to print about a phase. The shares are rough: refinement, if
 * there is any, takes most of the time.
 */
struct Phase
{
  const char* Begins; ///< how TetGen's line begins
  double Fraction;
  const char* Text;
};
constexpr std::array<Phase, 10> Phases = { {
  { "Delaunizing vertices", 0.02, "Delaunay tetrahedra of the surface points" },
  { "Creating surface mesh", 0.10, "Reading the surface" },
  { "Detecting self-inters", 0.10, "Looking for facets that intersect" },
  { "Recovering boundaries", 0.12, "Recovering the surface" },
  { "Constrained Delaunay", 0.12, "Recovering the surface" },
  { "Removing exterior", 0.25, "Removing the exterior" },
  { "Inserting constrained", 0.28, "Inserting interior points" },
  { "Refining mesh", 0.30, "Refining" },
  { "Optimizing mesh", 0.85, "Optimizing" },
  { "Writing nodes", 0.97, "Reading the mesh" },
} };

/**
 * Receives TetGen's output and determines the current phase.
 */
class TextReader
{
public:
  /// A line may come in pieces, so the search begins where the last line began.
  void Add(const char* data, std::size_t bytes)
  {
    const std::size_t begin = this->Text.rfind('\n') + 1; // npos + 1 is 0
    this->Text.append(data, std::min(bytes, KeptText - std::min(KeptText, this->Text.size())));
    for (const Phase& phase : Phases)
    {
      // Never back: a phase may print again later.
      if (phase.Fraction >= this->Current.Fraction &&
        this->Text.find(phase.Begins, begin) != std::string::npos)
      {
        this->Current = phase;
      }
    }
  }
  std::string Text;
  Phase Current = { "", 0.0, "Starting TetGen" };
};

/**
 * Reads the available data and appends it. False at the end of the file.
 */
template <typename Append>
bool ReadSome(int file, const Append& append)
{
  char buffer[1 << 16];
  const ssize_t n = ::read(file, buffer, sizeof buffer);
  if (n > 0)
  {
    append(buffer, static_cast<std::size_t>(n));
  }
  // Interrupted, or nothing there yet: not the end.
  return n > 0 || (n < 0 && (errno == EINTR || errno == EAGAIN));
}

/**
 * Reads both pipes until the child has closed them. Returns false if progress asked to stop. Both
 * at once: a child that waits at one full pipe while this process waits at the other would never
 * end.
 */
bool Listen(int textFile, int meshFile, const ChildProgress& progress, TextReader& text,
  std::vector<char>& message)
{
  struct pollfd files[2] = { { textFile, POLLIN, 0 }, { meshFile, POLLIN, 0 } };
  while (files[0].fd >= 0 || files[1].fd >= 0)
  {
    // A pipe at its end is ready, too; one that is done (-1) is passed over.
    const int ready = ::poll(files, 2, PollMilliseconds);
    if (ready > 0 && files[0].fd >= 0 && files[0].revents != 0 &&
      !ReadSome(textFile, [&](const char* data, std::size_t n) { text.Add(data, n); }))
    {
      files[0].fd = -1;
    }
    if (ready > 0 && files[1].fd >= 0 && files[1].revents != 0 &&
      !ReadSome(meshFile,
        [&](const char* data, std::size_t n) { message.insert(message.end(), data, data + n); }))
    {
      files[1].fd = -1;
    }
    // Asked at least every PollMilliseconds, so that an abort does not wait for TetGen.
    if (!progress(text.Current.Fraction, text.Current.Text))
    {
      return false;
    }
  }
  return true;
}

template <typename T>
const char* Unpack(const char* from, std::uint64_t length, std::vector<T>& array)
{
  array.resize(length);
  if (length > 0) // the data() of an empty vector may be a null pointer
  {
    std::memcpy(array.data(), from, length * sizeof(T));
  }
  return from + length * sizeof(T);
}

/**
 * The mesh from the child's message, if that is complete. `error` is TetGen's error number.
 */
bool Unpack(const std::vector<char>& message, std::int64_t& error, Mesh& mesh)
{
  Header header;
  if (message.size() < sizeof header)
  {
    return false;
  }
  std::memcpy(&header, message.data(), sizeof header);
  // The child may have died while it wrote: the lengths are checked against what has arrived.
  const std::size_t expected = sizeof header + header.Points * sizeof(double) +
    (header.Tetrahedra + header.Regions) * sizeof(int);
  if (header.Magic != HeaderMagic || message.size() != expected)
  {
    return false;
  }
  error = header.Error;
  const char* from = Unpack(message.data() + sizeof header, header.Points, mesh.Points);
  from = Unpack(from, header.Tetrahedra, mesh.Tetrahedra);
  Unpack(from, header.Regions, mesh.Regions);
  return true;
}

/**
 * Waits for the child and describes how it ended. One that nobody waits for would stay in the
 * system's table of processes.
 */
std::string Bury(pid_t child)
{
  int status = 0;
  pid_t ended;
  do
  {
    ended = ::waitpid(child, &status, 0);
  } while (ended < 0 && errno == EINTR);
  if (ended != child) // an application that ignores SIGCHLD gets no status
  {
    return "it ended before it was done";
  }
  if (WIFSIGNALED(status))
  {
    return std::string("it was ended by signal ") + std::to_string(WTERMSIG(status)) + ", " +
      ::strsignal(WTERMSIG(status));
  }
  return "it ended with status " + std::to_string(WEXITSTATUS(status));
}

} // namespace

//------------------------------------------------------------------------------
ChildOutcome RunInChild(const Job& job, const ChildProgress& progress, Mesh& mesh)
{
  // A child of another thread must not inherit the writing ends: this process would then never see
  // the end of the file.
  static std::mutex oneFork;
  std::unique_lock<std::mutex> lock(oneFork);
  ChildOutcome outcome;
  Pipe textPipe, meshPipe;
  if (!textPipe.IsOpen() || !meshPipe.IsOpen())
  {
    outcome.Reason = std::strerror(errno);
    return outcome;
  }
  std::fflush(stdout); // otherwise the child would print buffered text again
  // Without exec(): the child has the job in its memory, and no program has to be found. It
  // allocates memory, which POSIX does not promise beside other threads; glibc sees to it.
  const pid_t child = ::fork();
  if (child < 0)
  {
    outcome.Reason = std::strerror(errno);
    return outcome;
  }
  if (child == 0)
  {
    BeChild(job, textPipe.WriteEnd(), meshPipe.WriteEnd());
  }
  // The child alone must have the writing ends: the pipes end when it does, in whatever way.
  textPipe.Close(1);
  meshPipe.Close(1);
  lock.unlock();

  TextReader text;
  std::vector<char> message;
  bool goesOn = false;
  try
  {
    goesOn = Listen(textPipe.ReadEnd(), meshPipe.ReadEnd(), progress, text, message);
  }
  catch (...)
  {
    // Whatever progress() throws: no child may be left behind.
    ::kill(child, SIGKILL);
    Bury(child);
    throw;
  }
  // TetGen looks at nothing while it works: only a signal that cannot be caught ends it for sure.
  if (!goesOn)
  {
    ::kill(child, SIGKILL);
  }
  const std::string end = Bury(child);
  std::int64_t error = 0;
  outcome.Text = std::move(text.Text);
  if (!goesOn)
  {
    outcome.State = ChildOutcome::Aborted;
  }
  else if (!Unpack(message, error, mesh))
  {
    outcome.State = ChildOutcome::Failed;
    outcome.Reason = end;
  }
  else
  {
    outcome.State = error == 0 ? ChildOutcome::Done : ChildOutcome::Failed;
    outcome.Reason = error == 0 ? "" : "error " + std::to_string(error);
  }
  return outcome;
}

} // namespace vtkTetGenBridge
