// SPDX-License-Identifier: BSD-3-Clause
#include "MeshOptimizeWindow.h"

#include "vtksys/SystemTools.hxx"

#include <QCoreApplication>
#include <QLibrary>
#include <QTimer>

#include <dlfcn.h>

#include <string>

namespace
{

// Where the plugin is.
std::string Folder()
{
  Dl_info info;
  return dladdr(reinterpret_cast<void*>(&MeshOptimizeAddToolBar), &info) && info.dli_fname
    ? vtksys::SystemTools::GetFilenamePath(vtksys::SystemTools::CollapseFullPath(info.dli_fname))
    : std::string();
}

// Plugins named in PV_PLUGIN_PATH are loaded before the window is there: then later again.
void Add(int tries)
{
  const std::string folder = Folder();
  QLibrary library(QString::fromStdString(folder + "/Toolbar/MeshOptimizeToolbar.so"));
  using Function = bool (*)(const char*);
  const auto add = reinterpret_cast<Function>(library.resolve("MeshOptimizeToolbarAdd"));
  // The folder is that of our Python package, and needed where nothing else says where it is.
  if (add && !add((folder + "/" MESHOPTIMIZE_PYTHON_FROM_PLUGIN).c_str()) && tries > 0)
  {
    QTimer::singleShot(200, QCoreApplication::instance(), [tries]() { Add(tries - 1); });
  }
}

} // namespace

//------------------------------------------------------------------------------
void MeshOptimizeAddToolBar()
{
  QCoreApplication* application = QCoreApplication::instance();
  if (application && application->inherits("QApplication"))
  {
    QTimer::singleShot(0, application, []() { Add(300); });
  }
}
