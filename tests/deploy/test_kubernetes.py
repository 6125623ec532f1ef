"""The manifests: their parts fit each other, the image and the settings."""

from collections.abc import Mapping
from typing import Any

import pytest

from service.app import create_app
from service.fairness.table import shares
from service.settings import Settings
from tests.deploy.files import instructions, manifests, settings_variables
from tests.docs.reading import ROOT

ALL = manifests()
POD: Mapping[str, Any] = ALL["Deployment"]["spec"]["template"]["spec"]
CONTAINER: Mapping[str, Any] = POD["containers"][0]
LABELS = ALL["Deployment"]["spec"]["template"]["metadata"]["labels"]


def test_all_kinds_are_there() -> None:
    assert set(ALL) == {
        "ConfigMap",
        "Deployment",
        "NetworkPolicy",
        "PersistentVolumeClaim",
        "PodDisruptionBudget",
        "Secret",
        "Service",
    }


def test_everything_that_selects_pods_selects_these() -> None:
    for selector in (
        ALL["Deployment"]["spec"]["selector"]["matchLabels"],
        ALL["Service"]["spec"]["selector"],
        ALL["PodDisruptionBudget"]["spec"]["selector"]["matchLabels"],
        ALL["NetworkPolicy"]["spec"]["podSelector"]["matchLabels"],
        POD["topologySpreadConstraints"][0]["labelSelector"]["matchLabels"],
    ):
        assert selector.items() <= LABELS.items()


@pytest.fixture(scope="module")
def paths() -> frozenset[str]:
    """The paths of the service."""
    return frozenset(create_app(Settings()).openapi()["paths"])


@pytest.mark.parametrize(
    ("probe", "path"),
    [("startupProbe", "/readyz"), ("readinessProbe", "/readyz"), ("livenessProbe", "/healthz")],
)
def test_probes_ask_where_there_is_an_answer(probe: str, path: str, paths: frozenset[str]) -> None:
    """Alive and ready are different: a service that is not ready must not be ended for it."""
    probe_request = CONTAINER[probe]["httpGet"]
    assert probe_request["path"] == path
    assert probe_request["port"] in {port["name"] for port in CONTAINER["ports"]}
    assert path in paths


def test_the_settings_are_ones_of_the_service(monkeypatch: pytest.MonkeyPatch) -> None:
    for name, value in ALL["ConfigMap"]["data"].items():
        assert name in settings_variables()
        monkeypatch.setenv(name, value)
    settings = Settings()
    (keys,) = (mount for mount in CONTAINER["volumeMounts"] if mount["name"] == "keys")
    assert str(settings.keys_file) == f"{keys['mountPath']}/{POD['volumes'][2]['secret']['items'][0]['path']}"
    # one core for each computation; a container sees the cores of its node
    assert settings.concurrent_solves == int(CONTAINER["resources"]["limits"]["cpu"])


def test_the_secret_holds_what_is_taken_from_it() -> None:
    held = ALL["Secret"]["stringData"]
    taken = [variable["valueFrom"]["secretKeyRef"]["key"] for variable in CONTAINER["env"]]
    taken += [item["key"] for item in POD["volumes"][2]["secret"]["items"]]
    assert set(held) == set(taken)
    assert set(taken) - {"keys.jsonl"} <= settings_variables()


def test_the_user_is_that_of_the_image_and_has_no_rights() -> None:
    user, group = next(rest for kind, rest in instructions() if kind == "USER").split(":")
    security = POD["securityContext"]
    assert (security["runAsUser"], security["runAsGroup"]) == (int(user), int(group))
    assert security["runAsNonRoot"] is True
    assert CONTAINER["securityContext"]["readOnlyRootFilesystem"] is True
    assert CONTAINER["securityContext"]["capabilities"] == {"drop": ["ALL"]}
    assert POD["automountServiceAccountToken"] is False


def test_what_the_image_writes_to_is_mounted() -> None:
    assert {"/data", "/tmp"} <= {mount["mountPath"] for mount in CONTAINER["volumeMounts"]}
    assert {mount["name"] for mount in CONTAINER["volumeMounts"]} == {volume["name"] for volume in POD["volumes"]}


def test_a_replica_that_ends_has_the_time_that_it_asks_for() -> None:
    grace = int(ALL["ConfigMap"]["data"]["COUNTERWEIGHT_GRACEFUL_SHUTDOWN_S"])
    assert POD["terminationGracePeriodSeconds"] > grace + CONTAINER["lifecycle"]["preStop"]["sleep"]["seconds"]


def test_several_replicas_share_what_they_must() -> None:
    """SQLite on a folder that several nodes mount loses data, so two replicas need a database by URL."""
    assert ALL["Deployment"]["spec"]["replicas"] > 1
    assert ALL["PersistentVolumeClaim"]["spec"]["accessModes"] == ["ReadWriteMany"]
    assert ALL["Secret"]["stringData"]["COUNTERWEIGHT_DATABASE_URL"].startswith("postgresql://")
    assert ALL["PodDisruptionBudget"]["spec"] == {
        "maxUnavailable": 1,
        "selector": ALL["PodDisruptionBudget"]["spec"]["selector"],
    }


def test_memory_processors_and_disk_are_limited() -> None:
    assert CONTAINER["resources"]["limits"].keys() == {"cpu", "memory", "ephemeral-storage"}
    assert CONTAINER["resources"]["requests"].keys() == {"cpu", "memory", "ephemeral-storage"}
    assert all("sizeLimit" in volume["emptyDir"] for volume in POD["volumes"] if "emptyDir" in volume)


def test_memory_suffices_for_the_computations_that_it_allows() -> None:
    limit = int(CONTAINER["resources"]["limits"]["memory"].removesuffix("Gi")) * 2**30
    set_here = ALL["ConfigMap"]["data"]
    # two above them, for clients that had little lately; docs/operation.md: 300 MB for the service, each sweep worker
    solves = int(set_here["COUNTERWEIGHT_CONCURRENT_SOLVES"]) + shares(Settings())["short"].reserve
    counterweight_sweep_worker = int(set_here["COUNTERWEIGHT_SWEEP_WORKERS"]) + 1
    assert (solves * Settings().solve_memory_mb + counterweight_sweep_worker * 300) * 1_000_000 < limit


def test_no_proxy_is_believed_and_hosts_need_no_list_where_keys_are_asked_for() -> None:
    """Hosts are compared only where nobody needs a key, and there is a file of keys here."""
    assert ALL["ConfigMap"]["data"]["COUNTERWEIGHT_TRUSTED_PROXIES"] == ""
    assert "COUNTERWEIGHT_KEYS_FILE" in ALL["ConfigMap"]["data"]
    assert "COUNTERWEIGHT_ALLOW_WITHOUT_KEYS" not in ALL["ConfigMap"]["data"]


def test_the_network_lets_in_http_and_out_what_is_needed() -> None:
    policy = ALL["NetworkPolicy"]["spec"]
    assert [port["port"] for rule in policy["ingress"] for port in rule["ports"]] == ["http"]
    assert all(rule.get("to") for rule in policy["egress"])
    assert {port["port"] for rule in policy["egress"] for port in rule["ports"]} == {53, 5432, 8786, 4317, 4318}


@pytest.mark.parametrize(
    ("port", "label"),
    [(5432, {"counterweight-database": "true"}), (4318, {"counterweight-telemetry": "true"})],
)
def test_the_database_and_the_collector_may_be_in_a_namespace_of_their_own(port: int, label: dict[str, str]) -> None:
    rules = [
        rule
        for rule in ALL["NetworkPolicy"]["spec"]["egress"]
        if port in {rule_port["port"] for rule_port in rule["ports"]}
    ]
    places = [place.get("namespaceSelector", {}).get("matchLabels") for rule in rules for place in rule["to"]]
    assert label in places
    assert " ".join(f"{name}={value}" for name, value in label.items()) in (ROOT / "docs/operation.md").read_text()
