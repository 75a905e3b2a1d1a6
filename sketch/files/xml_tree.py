"""XML as a small tree that remembers lines: what InkML and the gesture formats are read from.

Prefixes are dropped, because published files use ones they never declare. Entities, external
references and deep nesting are refused (defusedxml), so that no file can blow up.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from xml.sax import SAXException, SAXParseException
from xml.sax.handler import ContentHandler
from xml.sax.saxutils import escape, quoteattr
from xml.sax.xmlreader import AttributesImpl

import defusedxml.sax
from defusedxml.common import DefusedXmlException

from sketch.files.errors import FileError

_MOST_NESTED = 64
"""Elements within one another; ink nests a handful."""
_MOST_ELEMENTS = 300_000
"""Elements of a file: a gesture has one for each point, and a stroke at most 200,000 points."""
_LONGEST_TEXT = 1 << 24
"""Characters directly inside an element: a trace of 200,000 points has some four million."""


UNWRITABLE = re.compile(r"[^\t\n\r\x20-\uD7FF\uE000-\uFFFD\U00010000-\U0010FFFF]")
"""A character that XML has no way to write."""


@dataclass(slots=True)
class Element:
    """name, attributes: without prefixes; text: all character data directly inside; line: 1-based."""

    name: str
    attributes: dict[str, str]
    line: int
    children: list[Element] = field(default_factory=list["Element"])
    pieces: list[str] = field(default_factory=list[str])

    @property
    def text(self) -> str:
        return "".join(self.pieces)

    def written(self) -> str:
        """The element as XML again, its text before its children; `id` and `lang` as XML's own."""
        names = {"id": "xml:id", "lang": "xml:lang"}
        attributes = "".join(
            f" {names.get(name, name)}={quoteattr(value)}" for name, value in self.attributes.items()
        )
        inside = escape(self.text.strip()) + "".join(child.written() for child in self.children)
        return f"<{self.name}{attributes}>{inside}</{self.name}>"

    def named(self, name: str) -> Iterator[Element]:
        """The children of that name."""
        return (child for child in self.children if child.name == name)

    def everything(self) -> Iterator[Element]:
        """This element and all below it, in the file's order."""
        yield self
        for child in self.children:
            yield from child.everything()


def parse(data: bytes, source: str | Path) -> Element:
    """The root element. Raises FileError for what is not well-formed XML, or is an attack."""
    handler = _TreeBuilder()
    try:
        defusedxml.sax.parseString(data, handler)
    except SAXParseException as error:
        raise FileError(
            source, f"is not well-formed XML: {error.getMessage()}", f"line {error.getLineNumber()}"
        ) from None
    except SAXException as error:
        raise FileError(source, str(error.getMessage())) from None
    except DefusedXmlException:
        raise FileError(
            source, "defines XML entities, which ink has no use for and which are refused"
        ) from None
    except (ValueError, LookupError) as error:  # an unknown encoding
        raise FileError(source, f"is not XML that can be read: {error}") from None
    if handler.root is None:
        raise FileError(source, "holds no XML element")
    return handler.root


class _TreeBuilder(ContentHandler):
    def __init__(self) -> None:
        super().__init__()
        self.root: Element | None = None
        self._open: list[Element] = []
        self._locator: Any = None
        self._elements = 0
        self._written = 0

    def setDocumentLocator(self, locator: Any) -> None:
        self._locator = locator

    def startElement(self, name: str, attrs: AttributesImpl) -> None:
        attributes = {_local(key): value for key, value in attrs.items()}
        element = Element(_local(name), attributes, int(self._locator.getLineNumber()))
        if self._open:
            self._open[-1].children.append(element)
        else:
            self.root = element
        self._open.append(element)
        self._elements += 1
        self._written = 0
        if self._elements > _MOST_ELEMENTS:
            raise SAXException(f"holds more than {_MOST_ELEMENTS} elements; split it")
        if len(self._open) > _MOST_NESTED:
            raise SAXException(f"nests elements more than {_MOST_NESTED} deep at line {element.line}")

    def endElement(self, name: str) -> None:  # noqa: ARG002  (the interface's)
        self._open.pop()

    def characters(self, content: str) -> None:
        self._written += len(content)
        if self._written > _LONGEST_TEXT:
            element = self._open[-1]
            raise SAXException(
                f"line {element.line}: <{element.name}> holds more than {_LONGEST_TEXT} characters of text"
            )
        self._open[-1].pieces.append(content)


def _local(name: str) -> str:
    return name.rpartition(":")[2]
