"""Records whose fields are declared once, with type, default, help text and section.

From the declarations come the checks of a record, options of the command line, the settings in the report, and the
tables of docs/options.md.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property, lru_cache
from typing import Any, ClassVar, NamedTuple, Self, dataclass_transform

from shapeblend_cli.options.types import FieldType


class Option(NamedTuple):
    """The declaration of a field."""

    kind: FieldType
    default: Any  # the value where none, or None, is given
    help: str  # one or two sentences, without the default
    section: str = ""  # the title under which help lists it; without it, that of the record
    many: bool = False  # the value is a tuple of such values, and the option may be repeated
    key: str = ""  # the name in the report; without it, that of the field
    flags: tuple[str, ...] = ()  # the names on the command line; without them, `--` and the key
    metavar: str = ""  # how help shows a value; without it, as the kind has it
    default_text: str | None = None  # how help shows the default; None for the default itself
    name: str = ""  # of the field

    def named(self, name: str, section: str) -> Option:
        """Return the option with the values that follow from its name and its record."""
        key = self.key or name
        return self._replace(
            name=name,
            section=self.section or section,
            key=key,
            flags=self.flags or (f"--{key.replace('_', '-')}",),
            metavar=self.metavar or self.kind.metavar,
        )

    @property
    def full_help(self) -> str:
        """The help with whether the option may be repeated, and the default."""
        text = f"{self.help} May be repeated." if self.many else self.help
        return f"{text}  [default: {self.shown_default}]" if self.shown_default else text

    @property
    def shown_default(self) -> str:
        """The default as help shows it; empty if that is to do nothing."""
        if self.default_text is not None:
            return self.default_text
        if self.default in (None, False, ()):
            return ""
        return f"{self.default:g}" if isinstance(self.default, float) else str(self.default)

    def checked(self, value: Any) -> Any:
        """Return a value in its canonical form, or raise ValueError: the name, what it must be, and what it is."""
        try:
            if not self.many:
                return self.kind.check(value)
            if isinstance(value, str):
                value = (value,)
            if not isinstance(value, Iterable):
                raise ValueError(f"must be a sequence, not {value!r}")
            return tuple(self.kind.check(one) for one in value)
        except ValueError as error:
            raise ValueError(f"{self.name} {error}") from None


def option(kind: FieldType, *, default: Any, help: str, **more: Any) -> Any:
    """Declare a field of a `Record`; see `Option`."""
    return Option(kind, default, help, **more)


@dataclass_transform(kw_only_default=True, frozen_default=True, field_specifiers=(option,))
class Record:
    """A value whose fields are declared by `option`. It is checked when it is made, and never changes."""

    options: ClassVar[dict[str, Option]] = {}
    given: dict[str, Any]  # as it was given
    _names: ClassVar[dict[str, str]] = {}  # of fields, by key
    _usual: ClassVar[dict[str, Any]] = {}  # default values

    def __init_subclass__(cls, section: str = "") -> None:
        own = {name: o.named(name, section) for name, o in vars(cls).items() if isinstance(o, Option)}
        cls.options = cls.options | own
        cls._names = {option.key: name for name, option in cls.options.items()}
        cls._usual = {name: option.default for name, option in cls.options.items()}
        attributes = (f"{name} : {cls.__annotations__[name]}\n    {o.help}" for name, o in own.items())
        summary = (cls.__doc__ or "").replace("\n    ", "\n").strip()
        cls.__doc__ = "\n".join((f"{summary}\n\nAttributes\n----------", *attributes))

    def __init__(self, **given: Any) -> None:
        given = self._by_name(given)
        if unknown := given.keys() - self.options.keys():
            fields = ", ".join(self.options)
            raise TypeError(f"{type(self).__name__} has no field {min(unknown)}; its fields are {fields}")
        given = {name: value for name, value in given.items() if value is not None}
        values = {name: self.options[name].checked(value) for name, value in given.items()}
        self.__dict__.update(self._defaults(values) | values, given=given)

    def _defaults(self, given: Mapping[str, Any]) -> dict[str, Any]:
        return self._usual

    @classmethod
    def _by_name(cls, values: Mapping[str, Any]) -> dict[str, Any]:
        """Return values by the names of fields, where they may have been given by keys: ``ks`` is ``k_s``."""
        return {name if name in cls.options else cls._names.get(name, name): x for name, x in values.items()}

    @classmethod
    def of(cls, values: Mapping[str, Any]) -> Self:
        """Make a record of values by name, in their canonical form; values without a field are left out."""
        given = tuple((name, values[name]) for name in cls.options if name in values)
        try:
            return cls._made(given)
        except TypeError:  # a list is not in its canonical form
            return cls(**dict(given))

    @classmethod
    @lru_cache(maxsize=256)
    def _made(cls, given: tuple[tuple[str, Any], ...]) -> Self:
        """Make a record. The jobs of a batch ask for few different ones."""
        return cls(**dict(given))

    @cached_property
    def listed(self) -> dict[str, Any]:
        """The values as JSON has them, by the keys of their fields."""
        return {option.key: _plain(getattr(self, name)) for name, option in self.options.items()}

    def is_given(self, name: str) -> bool:
        """Return whether a field was given a value."""
        return name in self.given

    def replace(self, **changes: Any) -> Self:
        """Return a record with other values in some fields; None stands for the default."""
        return type(self)(**self.given | self._by_name(changes))

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"{type(self).__name__} is frozen; replace({name}=...) makes a changed copy")

    @cached_property
    def values(self) -> tuple[Any, ...]:
        """The values of all fields."""
        return tuple(getattr(self, name) for name in self.options)

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and self.values == other.values

    def __hash__(self) -> int:
        return hash(self.values)

    def __repr__(self) -> str:
        given = (f"{name}={getattr(self, name)!r}" for name in self.options if name in self.given)
        return f"{type(self).__name__}({', '.join(given)})"


def _plain(value: Any) -> Any:
    if isinstance(value, complex):
        return [value.real, value.imag]
    if isinstance(value, tuple):
        return [_plain(one) for one in value] if type(value) is tuple else str(value)
    return value
