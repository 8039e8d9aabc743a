// SPDX-License-Identifier: BSD-3-Clause
//
// The toolbar "Mesh Optimize". Its buttons call functions of the Python module
// meshoptimize.paraview, so that scripts and ParaView's trace have them, too. They act on the
// source that is chosen in the pipeline browser. MeshOptimizeWindow.cxx loads this library.
#include "vtkPythonInterpreter.h"

#include <QAction>
#include <QApplication>
#include <QMainWindow>
#include <QToolBar>

#include <dlfcn.h>

#include <string>

namespace
{

struct Button
{
  const char* Text;
  const char* Function;
  const char* Tip;
  // ParaView 5.11 crashes where it does the place of a spreadsheet in a layout again, and at some
  // steps back from several new views. Such a press ends what can be undone.
  bool CanBeUndone;
};

const Button Buttons[] = {
  { "Worst elements", "show_worst_elements",
    "The worst elements of the chosen mesh: solid in the translucent mesh, and as a table", false },
  { "Histogram", "show_histogram", "How many elements of the chosen mesh have which quality",
    true },
  { "Before and after", "compare_before_and_after",
    "The mesh before and after the chosen Mesh Optimize filter, side by side", false },
  { "History", "show_history",
    "The worst and the mean quality after each pass of the chosen Mesh Optimize filter", true },
};

// While one is there, what happens is one step of ParaView's undo and redo; or nothing is left to
// undo at the end. ParaView's core and its stack of steps are known by their names only: their
// headers would need pqCore's -dev packages.
class UndoSet
{
public:
  explicit UndoSet(const Button& button)
    : CanBeUndone(button.CanBeUndone)
  {
    using Instance = QObject* (*)(); // pqApplicationCore::instance()
    const auto instance = reinterpret_cast<Instance>(
      dlsym(RTLD_DEFAULT, "_ZN17pqApplicationCore8instanceEv"));
    const QObject* core = instance ? instance() : nullptr;
    for (QObject* child : core ? core->children() : QObjectList())
    {
      if (child->inherits("pqUndoStack"))
      {
        this->Stack = child;
        QMetaObject::invokeMethod(child, "beginUndoSet", Q_ARG(QString, QString(button.Text)));
      }
    }
  }
  ~UndoSet()
  {
    if (this->Stack)
    {
      QMetaObject::invokeMethod(this->Stack, "endUndoSet");
      if (!this->CanBeUndone)
      {
        QMetaObject::invokeMethod(this->Stack, "clear");
      }
    }
  }
  UndoSet(const UndoSet&) = delete;
  UndoSet& operator=(const UndoSet&) = delete;

private:
  bool CanBeUndone;
  QObject* Stack = nullptr;
};

// What goes wrong is told in one line in ParaView's output messages.
void Call(const std::string& function, const std::string& pythonFolder)
{
  const std::string script = "import importlib.util, sys\n"
                             "if not importlib.util.find_spec('meshoptimize'):\n"
                             "  sys.path.append(r'" +
    pythonFolder +
    "')\n"
    "try:\n"
    "  import meshoptimize.paraview\n"
    "  meshoptimize.paraview." +
    function +
    "()\n"
    "except Exception as error:\n"
    "  from vtkmodules.vtkCommonCore import vtkOutputWindow\n"
    "  vtkOutputWindow.GetInstance().DisplayErrorText(f'Mesh Optimize: {error}\\n')\n";
  vtkPythonInterpreter::RunSimpleString(script.c_str());
}

QMainWindow* MainWindow()
{
  for (QWidget* widget : QApplication::topLevelWidgets())
  {
    auto* window = qobject_cast<QMainWindow*>(widget);
    if (window && window->isVisible())
    {
      return window;
    }
  }
  return nullptr;
}

} // namespace

//------------------------------------------------------------------------------
// False: there is no window yet.
extern "C" Q_DECL_EXPORT bool MeshOptimizeToolbarAdd(const char* pythonFolder)
{
  QMainWindow* window = MainWindow();
  if (!window || window->findChild<QToolBar*>("MeshOptimizeToolbar"))
  {
    return window != nullptr;
  }
  auto* bar = new QToolBar("Mesh Optimize", window);
  bar->setObjectName("MeshOptimizeToolbar");
  const std::string folder(pythonFolder);
  for (const Button& button : Buttons)
  {
    QAction* action = bar->addAction(button.Text);
    action->setObjectName(button.Function);
    action->setToolTip(button.Tip);
    QObject::connect(action, &QAction::triggered, bar,
      [button, folder]()
      {
        const UndoSet set(button);
        Call(button.Function, folder);
      });
  }
  window->addToolBar(bar);
  return true;
}
