"""Who may ask, and for what: everybody else is refused, whatever the path is written like."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.studio.running import Studio, running, with_piece


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    folder = with_piece(tmp_path_factory.mktemp("gate"))
    (folder / "secret.txt").write_text("secret")
    with running(folder, "leaf.yaml") as studio:
        studio.built()
        yield studio


JSON = {"Content-Type": "application/json"}


def test_the_link_opens_the_page_and_leaves_a_cookie(studio: Studio) -> None:
    status, headers, _ = studio.raw("GET", f"/?token={studio.token}")
    assert status == 200
    cookie = headers["set-cookie"]
    assert cookie.startswith(f"wrapit-{studio.port}={studio.token};")
    assert {"httponly", "samesite=strict", "path=/"} <= {part.strip().lower() for part in cookie.split(";")}
    assert "default-src 'none'" in headers["content-security-policy"]
    assert headers["referrer-policy"] == "no-referrer"
    assert headers["x-content-type-options"] == "nosniff"
    assert headers["cache-control"] == "no-store"


@pytest.mark.parametrize("path", ["/", "/state", "/events", "/drawing", "/file/report.json", "/nowhere"])
@pytest.mark.parametrize("token", ["", "x", "ä", "%00", "A" * 43])
def test_without_the_token_nothing_is_said(studio: Studio, path: str, token: str) -> None:
    for target, headers in (
        (path, {}),
        (f"{path}?token={token.encode().hex()}", {}),
        (path, {"Cookie": f"wrapit-{studio.port}={token}".encode().decode("latin-1")}),
        (path, {"Cookie": f"wrapit-{studio.port + 1}={studio.token}"}),
        (path, {"Cookie": 'a"b[=c; ,;='}),
    ):
        status, _, body = studio.raw("GET", target, headers)
        assert (status, body.count(b"\n")) == (403, 1)


@pytest.mark.parametrize(
    "host", ["evil.example", "127.0.0.1", "localhost", "127.0.0.1:1", "", "[::1]:{port}"]
)
def test_another_name_of_this_machine_is_refused(studio: Studio, host: str) -> None:
    headers = studio.cookie | {"Host": host.format(port=studio.port)}
    assert studio.raw("GET", "/state", headers)[0] in (400, 403)


def test_localhost_is_this_machine(studio: Studio) -> None:
    assert studio.raw("GET", "/state", studio.cookie | {"Host": f"localhost:{studio.port}"})[0] == 200


@pytest.mark.parametrize(
    "origin", ["null", "http://evil.example", "https://127.0.0.1:{port}", "http://127.0.0.1:1"]
)
@pytest.mark.parametrize("method", ["GET", "POST"])
def test_another_page_is_refused(studio: Studio, origin: str, method: str) -> None:
    headers = studio.cookie | JSON | {"Origin": origin.format(port=studio.port)}
    assert studio.raw(method, "/state" if method == "GET" else "/undo", headers, b"{}")[0] == 403


@pytest.mark.parametrize("site", ["cross-site", "same-site"])
def test_a_page_of_another_port_is_refused(studio: Studio, site: str) -> None:
    assert studio.raw("GET", "/state", studio.cookie | {"Sec-Fetch-Site": site})[0] == 403


@pytest.mark.parametrize(
    "headers",
    [
        {},
        JSON,
        {"Content-Type": "text/plain", "Sec-Fetch-Site": "same-origin"},
        {"Content-Type": "application/x-www-form-urlencoded", "Sec-Fetch-Site": "same-origin"},
        JSON | {"Sec-Fetch-Site": "cross-site"},
        JSON | {"Sec-Fetch-Site": "none"},
    ],
)
def test_a_change_that_a_form_could_send_is_refused(studio: Studio, headers: dict[str, str]) -> None:
    before = studio.config.read_bytes()
    body = json.dumps({"set": {"size": "90 mm"}}).encode()
    assert studio.raw("POST", "/change", studio.cookie | headers, body)[0] == 403
    assert studio.config.read_bytes() == before


@pytest.mark.parametrize("method", ["PUT", "DELETE", "PATCH", "OPTIONS", "TRACE"])
def test_other_methods_are_refused(studio: Studio, method: str) -> None:
    assert studio.raw(method, "/state", studio.cookie)[0] in (403, 405)


OUTSIDE = [
    "/file/../leaf.yaml",
    "/file/../../secret.txt",
    "/file/..%2f..%2fsecret.txt",
    "/file/%2e%2e%2f%2e%2e%2fsecret.txt",
    "/file/..%5c..%5csecret.txt",
    "/file/..\\..\\secret.txt",
    "/file//etc/passwd",
    "/file/%2fetc%2fpasswd",
    "/file/C:%5cWindows%5cwin.ini",
    "/file/report.json%00.png",
    "/file/.",
    "/file/",
    "/file/mine.txt",
    "/file/link.png",
    "/file/" + "a" * 300,
    "/assets/../session.py",
    "/assets/..%2fsession.py",
    "/assets/studio.html%00",
    "/assets//etc/passwd",
    "/secret.txt",
    "http://127.0.0.1/etc/passwd",
]


@pytest.mark.parametrize("target", OUTSIDE)
def test_no_path_leads_outside(studio: Studio, target: str) -> None:
    folder = studio.folder / "build" / "leaf"
    (folder / "mine.txt").write_text("mine")
    if not (folder / "link.png").is_symlink():
        (folder / "link.png").symlink_to(studio.folder / "secret.txt")
    status, _, body = studio.ask(target)
    assert status in (400, 403, 404), body
    assert b"secret" not in body
    assert b"root:" not in body


def test_a_file_of_the_build_that_became_a_link_is_gone(studio: Studio) -> None:
    path = studio.folder / "build" / "leaf" / "preview.png"
    kept = path.read_bytes()
    path.unlink()
    path.symlink_to(studio.folder / "secret.txt")
    try:
        assert studio.ask("/file/preview.png")[0] == 404
    finally:
        path.unlink()
        path.write_bytes(kept)
    assert studio.ask("/file/preview.png")[2] == kept


def test_files_of_the_build_are_served_as_what_they_are(studio: Studio) -> None:
    names = studio.state()["shown"]["files"]
    assert {"report.json", "drawing.svg", "preview.png", "guide.html"} <= names.keys()
    for name in names:
        status, headers, body = studio.ask(f"/file/{name}")
        assert (status, body) == (200, (studio.folder / "build" / "leaf" / name).read_bytes())
        assert headers["x-content-type-options"] == "nosniff"
    guide = studio.ask("/file/guide.html")[1]["content-security-policy"]
    assert "sandbox allow-scripts" in guide
    assert "allow-same-origin" not in guide
    assert "frame-ancestors 'self'" in guide


def test_the_drawing_can_be_looked_at_and_does_nothing(studio: Studio) -> None:
    status, headers, body = studio.ask("/drawing")
    assert (status, headers["content-type"]) == (200, "image/svg+xml")
    assert body == (studio.folder / "leaf.svg").read_bytes()
    assert headers["content-security-policy"].endswith("sandbox")


def test_a_drawing_that_is_none_is_not_read(studio: Studio) -> None:
    secret = studio.folder / "secret.txt"
    (studio.folder / "linked.png").symlink_to(secret)
    for named in (str(secret), "linked.png", "leaf.yaml"):
        before = studio.config.read_bytes()
        assert studio.post("/change", {"set": {"drawing": named}})[0] == 200
        assert studio.ask("/drawing")[0] == 404
        assert studio.post("/undo", {})[0] == 200
        assert studio.config.read_bytes() == before


@pytest.mark.parametrize("length", [1_500_001, 5_000_000])
def test_a_body_without_end_is_refused(studio: Studio, length: int) -> None:
    headers = studio.cookie | JSON | {"Origin": studio.origin}
    assert studio.raw("POST", "/text", headers, b" " * length)[0] == 413


@pytest.mark.parametrize("body", [b"", b"{", b"\xff", b"[" * 100_000, b"nope"])
@pytest.mark.parametrize("target", ["/change", "/text", "/undo", "/alternatives", "/fewer-wires"])
def test_a_body_that_is_no_json_is_refused(studio: Studio, target: str, body: bytes) -> None:
    headers = studio.cookie | JSON | {"Origin": studio.origin}
    status, _, answer = studio.raw("POST", target, headers, body)
    assert status == 400
    assert json.loads(answer)["error"]["problem"]


@pytest.mark.parametrize(
    ("target", "document"),
    [
        ("/change", []),
        ("/change", {"set": {"size": "-1 mm"}}),
        ("/change", {"set": {"sise": "4 cm"}}),
        ("/change", {"set": {"size": "\ud800"}}),
        ("/change", {"set": {"size": float("nan")}}),
        ("/change", {"unset": ["drawing"]}),
        ("/change", {"release": [7]}),
        ("/change", {"constrain": [{"same_wire": [1]}]}),
        ("/text", {"text": 3, "base": ""}),
        ("/text", {"text": "drawing: a.png"}),
        ("/alternatives", {"count": 0}),
        ("/alternatives", {"count": 1e9}),
        ("/alternatives", {"count": True}),
        ("/alternatives", "four"),
    ],
)
def test_what_makes_no_sense_is_refused_with_a_reason(studio: Studio, target: str, document: object) -> None:
    before = studio.config.read_bytes()
    status, answer = studio.post(target, document)
    assert status == 422
    assert answer["error"]["problem"]
    assert "\n" not in answer["error"]["problem"]
    assert str(Path("/tmp")) not in answer["error"]["where"]
    assert studio.config.read_bytes() == before
