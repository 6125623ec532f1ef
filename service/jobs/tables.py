"""The tables: jobs, their chunks, and the state of the database itself. Rows of a chunk are [start, stop)."""

from sqlalchemy import (
    BigInteger,
    Boolean,
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
    # an Arrow schema; null where the answer is no table
    Column("columns", LargeBinary),
    Column("state", String(16), nullable=False),
    Column("total", BigInteger, nullable=False),
    Column("done", BigInteger, nullable=False, default=0),
    # of the rows that are done: without a certified answer, those of them that are proven infeasible, and of designs
    # that break a rule
    Column("failed", BigInteger, nullable=False, default=0),
    Column("infeasible", BigInteger, nullable=False, default=0),
    Column("invalid", BigInteger, nullable=False, default=0),
    # chunks that went wrong more often than they are retried
    Column("faults", Integer, nullable=False, default=0),
    # grows with every change: the id of the event that tells of it
    Column("version", BigInteger, nullable=False, default=1),
    # seconds since 1970, to be shown
    Column("created", Double, nullable=False),
    Column("started", Double),
    Column("ended", Double),
    # in seconds that services have lived, see schema.lived
    Column("expires", Double),
    # why it failed, or why there is no selection
    Column("error", Text),
    Column("seed", BigInteger, nullable=False, default=0),
    # rows of a chunk, and the first row that is in no chunk yet
    Column("chunk_rows", BigInteger, nullable=False),
    Column("planned", BigInteger, nullable=False, default=0),
    # whether some rows are selected; how many were looked at for that, and how many stay
    Column("selects", Boolean, nullable=False, default=False),
    Column("selected", BigInteger, nullable=False, default=0),
    Column("kept", BigInteger, nullable=False, default=0),
    # chunks whose file was damaged or missing
    Column("repaired", Integer, nullable=False, default=0),
    # on disk now, and what was expected of the whole
    Column("bytes", BigInteger, nullable=False, default=0),
    Column("expected_bytes", BigInteger, nullable=False, default=0),
    Index("jobs_by_age", "created", "id"),
    Index("jobs_by_state", "state", "created"),
    Index("jobs_by_owner", "owner"),
)
# a null owner is one owner: nulls would all differ
Index("jobs_by_idempotency_key", func.coalesce(jobs.c.owner, ""), jobs.c.idempotency_key, unique=True)

chunks = Table(
    "chunks",
    metadata,
    Column("job", String(32), ForeignKey("jobs.id", ondelete="CASCADE"), primary_key=True),
    Column("start", BigInteger, primary_key=True),
    # the chunk that selects rows holds none: it starts and stops at the total
    Column("stop", BigInteger, nullable=False),
    Column("state", String(16), nullable=False, default="pending"),
    Column("attempts", Integer, nullable=False, default=0),
    Column("lease_owner", String(64)),
    Column("lease_until", Double),
    Column("finished", Double),
    # of the rows, how many failed, are proven infeasible or invalid; of the file, its digest and size. No digest:
    # written before there were digests
    Column("failed", BigInteger, nullable=False, default=0),
    Column("infeasible", BigInteger, nullable=False, default=0),
    Column("invalid", BigInteger, nullable=False, default=0),
    Column("digest", String(64)),
    Column("bytes", BigInteger, nullable=False, default=0),
    Index("chunks_by_state", "job", "state", "start"),
    Index("chunks_by_lease", "state", "lease_until"),
    Index("chunks_by_finish", "job", "finished"),
)

schema = Table(
    "schema",
    metadata,
    Column("number", Integer, nullable=False),
    # of this database: whose files are in a folder
    Column("identity", String(32), nullable=False),
    # seconds in which some service was there, by clocks that never jump
    Column("lived", Double, nullable=False, default=0.0),
)
