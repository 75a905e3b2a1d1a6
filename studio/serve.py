"""Starting the studio: the notebook's place, certificate and token for tablets, the browser."""

from __future__ import annotations

import datetime
import ipaddress
import os
import secrets
import socket
import sys
import threading
import time
import webbrowser
from dataclasses import dataclass
from pathlib import Path

import uvicorn

from studio.bundle import BundleError, bundle, current
from studio.guard import Doors
from studio.limits import LIMITS
from studio.server import Settings, make

LOOPBACK = ("127.0.0.1", "localhost", "::1")
CERTIFICATE_DAYS = 397
"""What browsers take at most."""


@dataclass(frozen=True, slots=True)
class Address:
    """Where the studio listens: host, port (0: any that is free), and whether encrypted."""

    host: str = "127.0.0.1"
    port: int = 8765
    tls: bool = False


def notebook_folder() -> Path:
    """$INKLINED_NOTEBOOK, or `inklined` in the system's place for a user's data."""
    given = os.environ.get("INKLINED_NOTEBOOK")
    if given:
        return Path(given)
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Application Support" / "inklined"
    return Path(os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share") / "inklined"


def serve(address: Address, folder: Path, browser: bool, warm: bool = True) -> None:
    """Serves until it is interrupted. Raises BundleError, OSError where the port is taken."""
    if not current():
        print("Building the studio's front end, once …", file=sys.stderr, flush=True)  # noqa: T201 - the terminal
        bundle()
    folder.mkdir(parents=True, exist_ok=True)
    listening = _listen(address)
    port = listening.getsockname()[1]
    beyond = address.host not in LOOPBACK
    token = secrets.token_urlsafe(18) if beyond else None
    names = {"localhost", socket.gethostname().casefold(), address.host.casefold()}
    app = make(Settings(folder / "notebook.sqlite", Doors(frozenset(names), token), warm))
    config = uvicorn.Config(
        app,
        log_level="warning",
        ws_max_size=LIMITS.message,
        ws_max_queue=16,
        timeout_graceful_shutdown=3,
        h11_max_incomplete_event_size=32_768,
        server_header=False,
    )
    if address.tls:
        config.ssl_certfile, config.ssl_keyfile = (str(path) for path in certificate(folder, address.host))
    link = url(address, port, token)
    _say(link, beyond, address.tls)
    if browser:
        threading.Thread(target=_show, args=(link,), daemon=True).start()
    uvicorn.Server(config).run(sockets=[listening])


def _listen(address: Address) -> socket.socket:
    family = socket.AF_INET6 if ":" in address.host else socket.AF_INET
    listening = socket.socket(family, socket.SOCK_STREAM)
    listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listening.bind((address.host, address.port))
    except OSError as error:
        listening.close()
        raise OSError(
            error.errno,
            f"{address.host}:{address.port} cannot be listened at ({error.strerror}); --port takes another",
        ) from None
    return listening


def url(address: Address, port: int, token: str | None) -> str:
    """What to open in a browser."""
    host = address.host
    if host in ("0.0.0.0", "::"):
        host = _own_address()
    if ":" in host:
        host = f"[{host}]"
    return f"http{'s' if address.tls else ''}://{host}:{port}/{f'?token={token}' if token else ''}"


def _own_address() -> str:
    """This machine's address towards others; nothing is sent."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))  # a network for documentation: never reached
            return str(probe.getsockname()[0])
        except OSError:
            return "127.0.0.1"


def _say(link: str, beyond: bool, tls: bool) -> None:
    told = [f"The studio is at {link}"]
    if beyond:
        told.append("Whoever has this address with its token may draw in your notebook.")
        if not tls:
            told.append("Nothing is encrypted: --tls does that, and browsers tell fine pen motion only then.")
    print("\n".join(told), flush=True)  # noqa: T201 - the terminal


def _show(link: str) -> None:
    time.sleep(0.6)
    webbrowser.open(link)


def certificate(folder: Path, host: str) -> tuple[Path, Path]:
    """(certificate, key) of this machine, self-signed, made when there is none or when it runs out."""
    from cryptography import x509
    from cryptography.hazmat.primitives import hashes, serialization
    from cryptography.hazmat.primitives.asymmetric import ec
    from cryptography.x509.oid import NameOID

    name = socket.gethostname()
    addresses = {"127.0.0.1", _own_address()} | ({host} if _is_address(host) else set())
    stem = folder / "certificate"
    chain, secret, made_for = stem.with_suffix(".pem"), stem.with_suffix(".key"), stem.with_suffix(".for")
    wanted = " ".join([name, *sorted(addresses)])
    if chain.is_file() and secret.is_file() and made_for.is_file() and made_for.read_text() == wanted:
        known = x509.load_pem_x509_certificate(chain.read_bytes())
        if known.not_valid_after_utc > datetime.datetime.now(datetime.UTC) + datetime.timedelta(days=7):
            return chain, secret
    key = ec.generate_private_key(ec.SECP256R1())
    now = datetime.datetime.now(datetime.UTC)
    subject = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, "inklined studio")])
    names: list[x509.GeneralName] = [x509.DNSName("localhost"), x509.DNSName(name)]
    names += [x509.IPAddress(ipaddress.ip_address(one)) for one in sorted(addresses) if not _is_any(one)]
    made = (
        x509.CertificateBuilder()
        .subject_name(subject)
        .issuer_name(subject)
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(now - datetime.timedelta(hours=1))
        .not_valid_after(now + datetime.timedelta(days=CERTIFICATE_DAYS))
        .add_extension(x509.SubjectAlternativeName(names), critical=False)
        .sign(key, hashes.SHA256())
    )
    secret.touch(mode=0o600)
    secret.write_bytes(
        key.private_bytes(
            serialization.Encoding.PEM, serialization.PrivateFormat.PKCS8, serialization.NoEncryption()
        )
    )
    chain.write_bytes(made.public_bytes(serialization.Encoding.PEM))
    made_for.write_text(wanted)
    return chain, secret


def _is_address(host: str) -> bool:
    try:
        ipaddress.ip_address(host)
    except ValueError:
        return False
    return True


def _is_any(host: str) -> bool:
    return ipaddress.ip_address(host).is_unspecified


__all__ = ["Address", "BundleError", "notebook_folder", "serve", "url"]
