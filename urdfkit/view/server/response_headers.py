"""Headers of every response of the page server."""

from urdfkit.network.access_control import host_name

EMPTY_STYLE = "'sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU='"
"""Hash of the empty string: meshcat's bundle creates an empty style element and fills it through the DOM."""

DAT_GUI_STYLES = ("'sha256-K7kXOYqP8pf16L5/PaLZ4u9Lt5q3nTyjCvyGtO/Af2k='",)
"""Hashes of the style sheets that meshcat's bundle injects for its own control panel, which is hidden here."""


def headers(host: str, *, framed: bool = False) -> dict[str, str]:
    """Return the headers of every response.

    Args:
        host: the Host header, for the address of the WebSocket (older Safari does not count it as 'self').
        framed: whether another page, such as a notebook, may show the response in a frame.
    """
    policy = {
        "default-src": "'none'",
        "script-src": "'self'",
        "style-src": " ".join(("'self'", EMPTY_STYLE, *DAT_GUI_STYLES)),
        "img-src": "'self' data: blob:",
        "connect-src": f"'self' ws://{host}" if host_name(host) else "'self'",
        "manifest-src": "'self'",
        "base-uri": "'none'",
        "form-action": "'none'",
        "frame-ancestors": "*" if framed else "'none'",
    }
    framing = {} if framed else {"X-Frame-Options": "DENY"}
    return framing | {
        "Content-Security-Policy": "; ".join(f"{name} {value}" for name, value in policy.items()),
        "X-Content-Type-Options": "nosniff",
        "Referrer-Policy": "no-referrer",
        "Cross-Origin-Opener-Policy": "same-origin",
        "Cross-Origin-Resource-Policy": "same-origin",
        "Permissions-Policy": "camera=(), microphone=(), geolocation=(), gamepad=(self), fullscreen=(self)",
        "Cache-Control": "no-store",
    }
