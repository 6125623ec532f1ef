"""Alert rules, dashboard and overlays: what they name is there, and the rules fire when they should (promtool)."""

import json
import re
import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path
from typing import Any

import pytest
import yaml
from jsonschema import Draft202012Validator

from service.app import create_app
from service.settings import Settings
from service.watch.metrics import Metrics
from tests.deploy.files import DEPLOY, ROOT, manifests

MONITORING = DEPLOY / "monitoring"
RULE: dict[str, Any] = yaml.safe_load((MONITORING / "prometheusrule.yaml").read_text())
DASHBOARD: dict[str, Any] = json.loads((MONITORING / "dashboard.json").read_text())
_METRIC = re.compile(r"\bcounterweight_[a-z_]+")
#: what a panel has to have so that Grafana shows it
PANEL = {
    "type": "object",
    "required": ["id", "title", "type", "datasource", "gridPos", "fieldConfig", "targets"],
    "properties": {
        "id": {"type": "integer", "minimum": 1},
        "title": {"type": "string", "minLength": 1},
        "type": {"enum": ["timeseries", "stat"]},
        "datasource": {"const": {"type": "prometheus", "uid": "${datasource}"}},
        "gridPos": {
            "type": "object",
            "required": ["x", "y", "w", "h"],
            "properties": {"x": {"type": "integer", "minimum": 0, "maximum": 23}, "w": {"maximum": 24}},
        },
        "fieldConfig": {
            "type": "object",
            "required": ["defaults", "overrides"],
            "properties": {"defaults": {"required": ["unit"]}},
        },
        "targets": {
            "type": "array",
            "minItems": 1,
            "items": {"type": "object", "required": ["refId", "expr", "legendFormat"]},
        },
    },
}
BOARD = {
    "type": "object",
    "required": ["uid", "title", "schemaVersion", "panels", "templating", "time"],
    "properties": {
        "uid": {"type": "string", "pattern": "^[a-z-]{1,40}$"},
        "schemaVersion": {"type": "integer", "minimum": 36},
        "panels": {"type": "array", "minItems": 6, "items": PANEL},
        "templating": {
            "properties": {"list": {"contains": {"properties": {"name": {"const": "datasource"}}}, "minItems": 1}}
        },
    },
}


def tool(name: str) -> str:
    """A program that may be missing."""
    executable = shutil.which(name)
    if executable is None:
        pytest.skip(f"{name} is missing: NOT CHECKED")
    return executable


def rules() -> list[dict[str, Any]]:
    actual_rules: list[dict[str, Any]] = [rule for group in RULE["spec"]["groups"] for rule in group["rules"]]
    return actual_rules


def names(metrics: Metrics) -> set[str]:
    """The series that the service gives."""
    metrics.requested("GET", "/v1/effects", 200, 0.1)
    metrics.refused("/v1/effects", "unauthorized")
    text = metrics.exposition().decode()
    families = re.findall(r"^# TYPE (\S+) (\S+)", text, re.MULTILINE)
    series = {name for name, kind in families if kind != "histogram"}
    return series | {f"{name}_{part}" for name, kind in families if kind == "histogram" for part in ("bucket", "count")}


@pytest.fixture(scope="module")
def series() -> set[str]:
    return names(create_app(Settings()).state.metrics)


def test_every_series_that_is_named_is_given(series: set[str]) -> None:
    exprs = [target["expr"] for panel in DASHBOARD["panels"] for target in panel["targets"]]
    for expression in [*(rule["expr"] for rule in rules()), *exprs]:
        named = set(_METRIC.findall(expression))
        assert named or "up{" in expression
        assert named <= series, expression


def test_rules_fire_when_they_should_and_else_do_not(tmp_path: Path) -> None:
    promtool = tool("promtool")
    (tmp_path / "rules.yaml").write_text(yaml.safe_dump(RULE["spec"]))
    cases = yaml.safe_load((ROOT / "tests/deploy/alerts.yaml").read_text())
    tried = {case["alertname"] for test in cases["tests"] for case in test["alert_rule_test"] if case.get("exp_alerts")}
    assert tried == {rule["alert"] for rule in rules()}
    shutil.copy(ROOT / "tests/deploy/alerts.yaml", tmp_path)
    for command in (["check", "rules", "rules.yaml"], ["test", "rules", "alerts.yaml"]):
        process = subprocess.run([promtool, *command], cwd=tmp_path, capture_output=True, text=True, check=False)
        assert process.returncode == 0, process.stdout + process.stderr


def test_the_rules_are_taken_out_as_the_file_says(tmp_path: Path) -> None:
    text = (MONITORING / "prometheusrule.yaml").read_text()
    command = re.search(r"python3 -c '(.+)' < prometheusrule.yaml", text)
    assert command is not None
    process = subprocess.run([sys.executable, "-c", command[1]], input=text, capture_output=True, text=True, check=True)
    assert yaml.safe_load(process.stdout) == RULE["spec"]


def test_the_dashboard_is_one() -> None:
    Draft202012Validator(BOARD).validate(DASHBOARD)
    ids = [panel["id"] for panel in DASHBOARD["panels"]]
    assert len(set(ids)) == len(ids)
    places = [(panel["gridPos"]["x"], panel["gridPos"]["y"]) for panel in DASHBOARD["panels"]]
    assert len(set(places)) == len(places)


def test_prometheus_reads_the_expressions_of_the_dashboard(tmp_path: Path) -> None:
    promtool = tool("promtool")
    exprs = [target["expr"] for panel in DASHBOARD["panels"] for target in panel["targets"]]
    recorded = [
        # the variables are Grafana's
        {"record": f"shown:{k}", "expr": expression.replace("$__rate_interval", "5m").replace("$__range", "1h")}
        for k, expression in enumerate(exprs)
    ]
    (tmp_path / "shown.yaml").write_text(yaml.safe_dump({"groups": [{"name": "shown", "rules": recorded}]}))
    process = subprocess.run([promtool, "check", "rules", "shown.yaml"], cwd=tmp_path, capture_output=True, check=False)
    assert process.returncode == 0, process.stdout + process.stderr


def test_what_is_scraped_is_the_service() -> None:
    monitor = yaml.safe_load((MONITORING / "servicemonitor.yaml").read_text())
    service = manifests()["Service"]
    assert monitor["spec"]["selector"]["matchLabels"].items() <= service["metadata"]["labels"].items()
    (endpoint,) = monitor["spec"]["endpoints"]
    assert endpoint["port"] in {port["name"] for port in service["spec"]["ports"]}
    assert endpoint["path"] in create_app(Settings()).openapi()["paths"]
    # the job of the alerts is the name of the Service
    assert f'up{{job="{service["metadata"]["name"]}"}}' in rules()[0]["expr"]


BASE = {"ConfigMap", "Deployment", "NetworkPolicy", "PersistentVolumeClaim", "PodDisruptionBudget", "Service"}


#: what each holds beside them
OVERLAYS: dict[str, set[str]] = {
    "kubernetes": set(),
    "overlays/single": set(),
    "overlays/cluster": {"HorizontalPodAutoscaler", "Ingress", "PrometheusRule", "ServiceMonitor"},
}


@cache
def resources_of(folder: str) -> list[dict[str, Any]]:
    """The resources that an overlay comes to."""
    process = subprocess.run(
        [tool("kubectl"), "kustomize", DEPLOY / folder], capture_output=True, text=True, check=False
    )
    assert process.returncode == 0, process.stderr
    return list(yaml.safe_load_all(process.stdout))


def test_overlays_are_what_kubernetes_knows(tmp_path: Path) -> None:
    names = [f"{folder.replace('/', '-')}.yaml" for folder in OVERLAYS]
    for name, folder in zip(names, OVERLAYS, strict=True):
        # resources of the operator have no schema among those of Kubernetes
        own = [
            resource
            for resource in resources_of(folder)
            if not resource["apiVersion"].startswith("monitoring.coreos.com")
        ]
        (tmp_path / name).write_text(yaml.safe_dump_all(own))
    validate = Path(sys.executable).with_name("kubernetes-validate")
    checked = subprocess.run([validate, "--strict", *names], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert checked.returncode == 0, checked.stdout + checked.stderr
    assert all(name in checked.stdout for name in names)


@pytest.mark.parametrize("folder", OVERLAYS)
def test_overlays_are_manifests(folder: str) -> None:
    resources = resources_of(folder)
    assert {resource["kind"] for resource in resources} == BASE | OVERLAYS[folder]
    by_kind = {resource["kind"]: resource for resource in resources}
    deployment = by_kind["Deployment"]["spec"]
    if folder.endswith("single"):
        container = deployment["template"]["spec"]["containers"][0]
        assert (deployment["replicas"], deployment["strategy"]) == (1, {"type": "Recreate"})
        assert "COUNTERWEIGHT_DATABASE_URL" not in {variable["name"] for variable in container.get("env", [])}
        assert by_kind["PersistentVolumeClaim"]["spec"]["accessModes"] == ["ReadWriteOnce"]
    if folder.endswith("cluster"):
        assert "replicas" not in deployment
        scaled = by_kind["HorizontalPodAutoscaler"]["spec"]
        assert scaled["scaleTargetRef"]["name"] == by_kind["Deployment"]["metadata"]["name"]
        assert scaled["minReplicas"] >= 3
        backend = by_kind["Ingress"]["spec"]["rules"][0]["http"]["paths"][0]["backend"]["service"]
        assert backend["name"] == by_kind["Service"]["metadata"]["name"]
        assert backend["port"]["name"] in {port["name"] for port in by_kind["Service"]["spec"]["ports"]}
        (tls,) = by_kind["Ingress"]["spec"]["tls"]
        assert tls["hosts"] == [by_kind["Ingress"]["spec"]["rules"][0]["host"]]


def test_the_network_policy_lets_monitoring_in() -> None:
    assert "kubectl label namespace monitoring counterweight-client=true" in (ROOT / "docs/operation.md").read_text()
