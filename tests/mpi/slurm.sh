#!/usr/bin/env bash
# Runs the command by srun, in a Slurm of its own: one node, in a network namespace.
#
#   tests/mpi/slurm.sh PATH-OF-SPINCAT
#
# Exit code 77: cannot be tried here, with the reason.
set -euo pipefail
spincat="$1"

skip() { echo "skipped: $*"; exit 77; }
fail() { echo "FAILED: $*" >&2; tail -n 20 "$work"/*.err "$work"/*.log >&2 || true; exit 1; }

[ "$(id -u)" -eq 0 ] || skip "a Slurm of its own needs root"
for program in ip slurmctld slurmd srun munged; do
  command -v "$program" >/dev/null || [ -x "/usr/sbin/$program" ] || skip "$program is not installed"
done
PATH="$PATH:/usr/sbin"
work="$(mktemp -d /tmp/spincat-slurm.XXXXXX)"
chmod 755 "$work"
space="scs$$"
cleanup() {
  for process in $(ip netns pids "$space" 2>/dev/null); do kill -9 "$process" 2>/dev/null || true; done
  ip netns del "$space" 2>/dev/null || true
  rm -rf "/etc/netns/$space" "$work"
}
trap cleanup EXIT
ip netns add "$space" 2>"$work/netns.err" || skip "no network namespaces here: $(cat "$work/netns.err")"
ip netns exec "$space" true 2>"$work/netns.err" || skip "no way into a network namespace here: $(cat "$work/netns.err")"
ip -n "$space" link set lo up
ip -n "$space" link add one type veth peer name two || skip "no virtual network cards here"
ip -n "$space" address add 10.78.0.1/24 dev one
ip -n "$space" link set one up
ip -n "$space" link set two up
mkdir -p "/etc/netns/$space" "$work/state" "$work/spool" "$work/munge"
printf '127.0.0.1 localhost\n10.78.0.1 node1\n' >"/etc/netns/$space/hosts"
chmod 700 "$work/munge"
head -c 128 /dev/urandom >"$work/munge/key"
chmod 600 "$work/munge/key"
processors="$(nproc)"
cat >"$work/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=node1
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SchedulerType=sched/builtin
ReturnToService=2
NodeName=node1 CPUs=$processors State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP OverSubscribe=FORCE:8
CONF
# slurmd looks for cgroups although nothing here uses them, and entering a network namespace mounts a new /sys without
# any: those of version 2 are mounted again; where they are of version 1 (or both), it does that itself.
if [ -e /sys/fs/cgroup/cgroup.controllers ]; then
  printf 'CgroupPlugin=cgroup/v2\n' >"$work/cgroup.conf"
  cgroups='mount -t cgroup2 none /sys/fs/cgroup 2>/dev/null || true'
else
  printf 'CgroupPlugin=cgroup/v1\nCgroupAutomount=yes\n' >"$work/cgroup.conf"
  cgroups='mount -t tmpfs none /sys/fs/cgroup 2>/dev/null || true'
fi
inside() { ip netns exec "$space" unshare -u sh -c "hostname node1; $cgroups; exec \"\$@\"" sh "$@"; }
export SLURM_CONF="$work/slurm.conf"
inside munged --force --foreground --key-file "$work/munge/key" --socket "$work/munge.socket" \
  --pid-file "$work/munge/pid" --log-file "$work/munge/log" --seed-file "$work/munge/seed" >"$work/munged.err" 2>&1 </dev/null &
for _ in $(seq 100); do [ -S "$work/munge.socket" ] && break; sleep 0.05; done
inside slurmctld -D >"$work/slurmctld.err" 2>&1 </dev/null &
inside slurmd -D -N node1 >"$work/slurmd.err" 2>&1 </dev/null &
for _ in $(seq 200); do
  inside sinfo -h -o %t 2>/dev/null | grep -q idle && break
  sleep 0.1
done
inside sinfo -h -o %t 2>/dev/null | grep -q idle || skip "Slurm does not start here: $(tail -n 1 "$work/slurmd.log" "$work/slurmctld.log" 2>/dev/null | tr '\n' ' ')"

awk 'BEGIN{n=30; printf "OFF\n%d %d 0\n",2*n*n,(n-1)*2*n; p=3.14159265358979; for(i=0;i<n;i++)for(j=0;j<2*n;j++){t=(i+.5)*p/n;f=j*p/n;r=1+.1*sin(5*t)*cos(3*f);print r*sin(t)*cos(f),r*sin(t)*sin(f),r*cos(t)} for(i=0;i<n-1;i++)for(j=0;j<2*n;j++){k=(j+1)%(2*n);print 4,i*2*n+j,(i+1)*2*n+j,(i+1)*2*n+k,i*2*n+k}}' >"$work/scan.off"
arguments=(spin "$work/scan.off" --image-width 16 --threads 1)
"$spincat" "${arguments[@]}" -o "$work/alone.npy" >/dev/null
tried=0
for pair in openmpi:pmix mpich:pmi2; do
  plugin="$(dirname "$spincat")/mpi/spincat_mpi_${pair%:*}.so"
  [ -e "$plugin" ] || { echo "no plug-in for ${pair%:*}"; continue; }
  inside timeout -k 1 60 srun --mpi="${pair#*:}" --overcommit -n 2 "$spincat" "${arguments[@]}" -o "$work/ranks.npy" \
    >"$work/run.out" 2>"$work/run.err" </dev/null || fail "srun --mpi=${pair#*:}"
  grep -q "2 ranks on 1 host" "$work/run.err" || fail "srun --mpi=${pair#*:}: not two ranks"
  cmp "$work/alone.npy" "$work/ranks.npy" || fail "srun --mpi=${pair#*:}: other bytes"
  rm "$work/ranks.npy"
  tried=$((tried + 1))
done
[ "$tried" -gt 0 ] || skip "the build has no MPI plug-in"

# Without --mpi every task would be alone: refused by one line.
if inside timeout -k 1 60 srun --mpi=none --overcommit -n 2 "$spincat" "${arguments[@]}" -o "$work/ranks.npy" \
  >"$work/none.out" 2>"$work/none.err" </dev/null; then
  fail "srun --mpi=none was not refused"
fi
grep -q "srun has started 2 processes, but there is no MPI for it" "$work/none.err" || fail "srun --mpi=none: no advice"

# The job script of docs/guide/cluster.md.
cat >"$work/job.sh" <<JOB
#!/bin/sh
#SBATCH --ntasks=2 --overcommit --output=$work/job.log
srun --mpi=pmix --overcommit $spincat ${arguments[*]} -o $work/job.npy
JOB
if [ -e "$(dirname "$spincat")/mpi/spincat_mpi_openmpi.so" ]; then
  inside timeout 60 sbatch --wait "$work/job.sh" >"$work/sbatch.err" 2>&1 </dev/null || fail "sbatch"
  cmp "$work/alone.npy" "$work/job.npy" || fail "sbatch: other bytes"
fi
echo "srun with $tried MPI(s) and sbatch: the same bytes"
