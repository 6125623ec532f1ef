"""The tables as they were before the schema had a number (regression: the first release)."""

from sqlalchemy import (
    BigInteger,
    Column,
    Double,
    ForeignKey,
    Index,
    Integer,
    LargeBinary,
    MetaData,
    String,
    Table,
    Text,
    func,
)

metadata = MetaData()

jobs = Table(
    "jobs",
    metadata,
    Column("id", String(32), primary_key=True),
    Column("kind", String(32), nullable=False),
    Column("request", LargeBinary, nullable=False),
    Column("digest", String(64), nullable=False),
    Column("idempotency_key", String(255)),
    Column("owner", String(255)),
    Column("columns", LargeBinary),
    Column("state", String(16), nullable=False),
    Column("total", BigInteger, nullable=False),
    Column("done", BigInteger, nullable=False, default=0),
    Column("failed", BigInteger, nullable=False, default=0),
    Column("faults", Integer, nullable=False, default=0),
    Column("version", BigInteger, nullable=False, default=1),
    Column("created", Double, nullable=False),
    Column("started", Double),
    Column("ended", Double),
    Column("expires", Double),
    Column("error", Text),
    Index("jobs_by_age", "created", "id"),
    Index("jobs_by_state", "state", "created"),
)
Index("jobs_by_idempotency_key", func.coalesce(jobs.c.owner, ""), jobs.c.idempotency_key, unique=True)

chunks = Table(
    "chunks",
    metadata,
    Column("job", String(32), ForeignKey("jobs.id", ondelete="CASCADE"), primary_key=True),
    Column("start", BigInteger, primary_key=True),
    Column("stop", BigInteger, nullable=False),
    Column("state", String(16), nullable=False, default="pending"),
    Column("attempts", Integer, nullable=False, default=0),
    Column("lease_owner", String(64)),
    Column("lease_until", Double),
    Column("finished", Double),
    Index("chunks_by_state", "job", "state", "start"),
)
