"""Stores in object storage: S3 as moto serves it, through fsspec."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from reference.sweep_scenes import KEEP, space

import carom

pytestmark = pytest.mark.filterwarnings("ignore")  # (of the servers' and of botocore's own)


@pytest.fixture
def bucket(monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    # (loaded where they are needed: every worker collects this file)
    pytest.importorskip("s3fs")
    server = pytest.importorskip("moto.server")
    import boto3

    made = server.ThreadedMotoServer(ip_address="127.0.0.1", port=0)
    made.start()
    host, port = made.get_host_and_port()
    for name, value in (
        ("AWS_ENDPOINT_URL", f"http://{host}:{port}"),
        ("AWS_ACCESS_KEY_ID", "test"),
        ("AWS_SECRET_ACCESS_KEY", "test"),
        ("AWS_DEFAULT_REGION", "us-east-1"),
        ("AWS_MAX_ATTEMPTS", "1"),  # (what is not there is not asked for five times, with pauses)
    ):
        monkeypatch.setenv(name, value)
    boto3.client("s3").create_bucket(Bucket="sweeps")
    yield "s3://sweeps"
    made.stop()


@pytest.mark.slow
def test_a_sweep_in_a_bucket(bucket: str) -> None:
    with pytest.raises(carom.CaromError, match="got nothing there"):
        carom.sweep(f"{bucket}/s.zarr")
    made = carom.sweep(space(), KEEP, store=f"{bucket}/s.zarr", block=100)
    made.run(part=(1, 2))
    again = carom.sweep(f"{bucket}/s.zarr")
    assert 0 < len(again.missing()) < again.blocks.number
    found = again.run()
    memory = carom.sweep(space(), KEEP).run()
    for name in memory.data_vars:
        assert np.array_equal(found[name].values, memory[name].values, equal_nan=found[name].dtype.kind == "f")
    assert again.verify(2) == []
    with pytest.raises(carom.CaromError, match="got the store of another, which differs in keep"):
        carom.sweep(space(), ["final.spin"], store=f"{bucket}/s.zarr", block=100).run()


def test_a_bucket_that_is_not_there(bucket: str) -> None:
    with pytest.raises(carom.CaromError) as caught:
        carom.sweep(space(), KEEP, store="s3://elsewhere/s.zarr", block=100).run()
    assert len(caught.value.faults) == 1
