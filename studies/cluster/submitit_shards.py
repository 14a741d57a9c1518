"""The shards of a study as jobs of SLURM, with submitit:  python submitit_shards.py study.toml result 4"""

import sys

import submitit

import planemotion


def compute(study: str, out: str, shard: int, of: int) -> None:
    """What a job does; one that was killed goes on where it was when it runs again."""
    planemotion.load(study).sweep_shard(shard, of, out=out, workers=2)


def main(study: str, out: str, jobs: int, cluster: str | None = None) -> None:
    executor = submitit.AutoExecutor(folder=f"{out}.jobs", cluster=cluster)
    executor.update_parameters(timeout_min=60, cpus_per_task=2, name="planemotion")
    shards = range(1, jobs + 1)
    running = executor.map_array(compute, [study] * jobs, [out] * jobs, shards, [jobs] * jobs)
    for job in running:
        job.result()
    planemotion.load(study).sweep(out=out, resume=True)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], int(sys.argv[3]), *sys.argv[4:])
