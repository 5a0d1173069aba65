# SPDX-License-Identifier: MIT
# The array jobs of docs/sequences.md, run by a Slurm of one node that this test starts and stops: its frames are those of one
# run, byte for byte, and its parts of a reference join to the image of one.
set -eu
. tests/checks/common.sh
for tool in slurmctld slurmd sbatch munged; do
    command -v $tool >/dev/null || { echo "skipped: $tool is not installed (package slurm-wlm)"; exit 0; }
done
[ "$(id -u)" = 0 ] || { echo "skipped: a Slurm of one's own needs root"; exit 0; }
blocks=$(code_blocks docs/sequences.md sh)
own=$(mktemp -d /tmp/lampion-slurm-XXXXXX) # munged wants a socket where no one else may write, by a short name
daemons=
stop() {
    for daemon in $daemons; do kill "$daemon" 2>/dev/null && wait "$daemon" || true; done
    rm -rf "$own"
}
trap stop EXIT
trap 'exit 1' INT TERM
cd "$WORK"
own_scene scene.gltf
PATH=$BUILD:$PATH
export PATH SLURM_CONF="$own/slurm.conf" XDG_CACHE_HOME="$WORK/cache"

# script NAME TEXT: writes the job of the page that contains TEXT.
script() {
    printf '%s\n' "$blocks" | awk -v text="$2" '
        /^#!\/bin\/sh/ { block = ""; inside = 1 }
        inside { block = block $0 "\n" }
        inside && index($0, text) { printf "%s", block; exit }' >"$1"
    grep -q '^#SBATCH --array' "$1" || fail "docs/sequences.md has no array job with $2"
}
script frames.sh 'lampion render'
script parts.sh 'lampion reference'
sed -i 's/lampion render/& --size 32x20/; s/0-99/0-7/' frames.sh # small
sed -i 's/lampion reference/& --size 32x20/' parts.sh

cat >"$SLURM_CONF" <<END
ClusterName=lampion
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmUser=root
SlurmctldPort=26817
SlurmdPort=26818
AuthInfo=socket=$own/munge.socket
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
StateSaveLocation=$own/state
SlurmdSpoolDir=$own/spool
SlurmctldPidFile=$own/slurmctld.pid
SlurmdPidFile=$own/slurmd.pid
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES
END
mkdir "$own/state" "$own/spool"
(umask 077 && head -c 1024 /dev/urandom >"$own/key")
munged --foreground --force --key-file "$own/key" --socket "$own/munge.socket" --pid-file "$own/munge.pid" \
    --log-file "$own/munge.log" --seed-file "$own/seed" >munged.log 2>&1 &
daemons=$!
for wait in $(seq 50); do [ -S "$own/munge.socket" ] && break; sleep 0.1; done
slurmctld -D >slurmctld.log 2>&1 &
daemons="$! $daemons"
slurmd -D >slurmd.log 2>&1 &
daemons="$! $daemons"
for wait in $(seq 100); do sinfo -h -o %t 2>/dev/null | grep -q idle && break; sleep 0.2; done
sinfo -h -o %t | grep -q idle || fail "Slurm does not start: $(tail -n 3 munged.log slurmctld.log slurmd.log)"

for job in frames parts; do
    timeout 300 sbatch --wait "$job.sh" >"$job.log" 2>&1 || fail "$job.sh: $(cat "$job.log" slurm-*.out)"
done
lampion render scene.gltf --size 32x20 --frames 0-7 -o whole_%04d.png
for frame in 0 1 2 3 4 5 6 7; do
    cmp "frame_000$frame.png" "whole_000$frame.png" || fail "frame $frame is another"
done
lampion merge part*.exr -o truth.exr
lampion reference scene.gltf --size 32x20 --spp 8 -o whole.exr
lampion compare truth.exr whole.exr --fail-above rmse=1e-6 >/dev/null || fail "the parts are not the whole"
echo "tried: 12 tasks of array jobs by Slurm"
