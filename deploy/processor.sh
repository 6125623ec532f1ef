#!/bin/sh
# For which processor kernels are compiled, or loaded: x86-64-v3 (AVX2 and FMA, of 2013 and later) where this one has
# all that it stands for, else generic, which every processor of the architecture runs.
set -eu

flags=$(sed -n 's/^flags[^:]*: *//p' "${CPUINFO:-/proc/cpuinfo}" 2> /dev/null | head -n 1)
for flag in avx avx2 bmi1 bmi2 f16c fma abm movbe xsave; do
    case " $flags " in
        *" $flag "*) ;;
        *) echo generic && exit ;;
    esac
done
echo x86-64-v3
