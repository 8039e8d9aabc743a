import sys, meshoptimize  # /usr/bin/python3 one_call.py IN.vtu OUT.vtu

mesh, report = meshoptimize.optimize(meshoptimize.read(sys.argv[1]), target_quality=0.3)
print(report)
meshoptimize.write(mesh, sys.argv[2])
