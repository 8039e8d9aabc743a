"""What each effort reaches, and in what time, as a picture: /usr/bin/python3 parameter_study.py IN.vtu OUT.png"""
import sys

import matplotlib

matplotlib.use("Agg")  # no window
import matplotlib.pyplot as plt  # noqa: E402
import meshoptimize  # noqa: E402

TARGETS = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6)

mesh = meshoptimize.read(sys.argv[1])
figure, (quality, time) = plt.subplots(1, 2, figsize=(10, 4.5))
for effort in ("quick", "default"):
    reports = [meshoptimize.optimize(mesh, target_quality=target, effort=effort, time_limit=60)[1] for target in TARGETS]
    quality.plot(TARGETS, [report.worst_after for report in reports], "o-", label=effort)
    time.plot(TARGETS, [report.seconds for report in reports], "o-", label=effort)
    for target, report in zip(TARGETS, reports):
        print(f"{effort}, target {target}: worst {report.worst_after:.4f} in {report.seconds:.2f} s, {report.stop_reason}")

bound = reports[0].bound
quality.plot(TARGETS, TARGETS, ":", color="grey", label="target")
quality.axhline(bound, color="black", linewidth=0.8, label=f"bound of this surface, {bound:.3f}")
quality.set(xlabel="target quality", ylabel="worst quality", ylim=(0, None))
time.set(xlabel="target quality", ylabel="seconds", ylim=(0, None))
quality.legend()
time.legend()
figure.tight_layout()
figure.savefig(sys.argv[2], dpi=120)
