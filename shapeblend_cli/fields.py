"""Records whose fields are options: each is declared once, with its type, default, help text and section.

From the declarations come the checks of a record, the options of the command line, the settings in the report and
the tables of options in the README.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, ClassVar, Self, dataclass_transform

if TYPE_CHECKING:
    from collections.abc import Mapping

    from shapeblend_cli.field_types import FieldType


class Option:
    """What is known of an option; see `option`."""

    def __init__(self, kind: FieldType, default: Any, help: str, section: str, **more: Any) -> None:
        self.kind = kind
        self.default = default
        self.help = help
        self.section = section
        self.many: bool = more.pop("many", False)
        self.key: str = more.pop("key", "")
        self.flags: tuple[str, ...] = more.pop("flags", ())
        self.metavar: str = more.pop("metavar", kind.metavar)
        self._default_text: str | None = more.pop("default_text", None)
        assert not more, more

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name
        self.key = self.key or name
        self.flags = self.flags or (f"--{self.key.replace('_', '-')}",)

    @property
    def default_text(self) -> str:
        """The default as the help states it; empty for a flag, or where the default is to do nothing."""
        if self._default_text is not None:
            return self._default_text
        if self.many or self.default is None or self.default is False:
            return ""
        return f"{self.default:g}" if isinstance(self.default, float) else str(self.default)

    @property
    def full_help(self) -> str:
        """The help with whether the option may be repeated, and the default."""
        text = f"{self.help} May be repeated." if self.many else self.help
        return f"{text}  [default: {self.default_text}]" if self.default_text else text

    def checked(self, value: Any) -> Any:
        """Return a value in its canonical form.

        Raises
        ------
        ValueError
            Names the field, what it must be, and the value.
        """
        try:
            if not self.many:
                return self.kind.check(value)
            if not isinstance(value, Iterable):
                raise ValueError(f"must be a sequence, not {value!r}")
            return tuple(self.kind.check(one) for one in value)
        except ValueError as error:
            raise ValueError(f"{self.name} {error}") from None

    def plain(self, value: Any) -> Any:
        """Return a value of the field as JSON has it."""
        return [self.kind.plain(one) for one in value] if self.many else self.kind.plain(value)


def option(kind: FieldType, *, default: Any, help: str, section: str, **more: Any) -> Any:
    """Declare a field of a `Record`.

    Parameters
    ----------
    kind : FieldType
        How values are read, checked and written.
    default : any
        Its value where none, or None, is given.
    help : str
        One or two sentences; the default is added.
    section : str
        The title under which help lists it.
    **more
        `many`: whether it is a tuple of such values, and the option may be repeated. `key`: its name in the report,
        if not the field's. `flags`: its names on the command line, if not `--` and the key. `metavar`: how help shows
        its value. `default_text`: what help says of the default, if not its value.
    """
    return Option(kind, default, help, section, **more)


@dataclass_transform(kw_only_default=True, frozen_default=True, field_specifiers=(option,))
class Record:
    """A value whose fields are declared by `option`. It is checked when it is made, and never changes."""

    options: ClassVar[dict[str, Option]] = {}
    _given: dict[str, Any]

    def __init_subclass__(cls) -> None:
        own = {name: value for name, value in vars(cls).items() if isinstance(value, Option)}
        cls.options = cls.options | own
        types = cls.__annotations__
        attributes = (f"{name} : {types[name]}\n    {own[name].help}" for name in own)
        cls.__doc__ = "\n".join((f"{cls.__doc__}\n\nAttributes\n----------", *attributes))

    def __init__(self, **given: Any) -> None:
        self.__dict__["_given"] = {name: value for name, value in given.items() if value is not None}
        if unknown := given.keys() - self.options.keys():
            fields = ", ".join(self.options)
            raise TypeError(f"{type(self).__name__} has no field {min(unknown)}; its fields are {fields}")
        values = {name: self.options[name].checked(value) for name, value in self._given.items()}
        self.__dict__.update(self._defaults(values) | values)

    def _defaults(self, given: Mapping[str, Any]) -> dict[str, Any]:
        """The values of all fields where none is given, which may depend on those that are."""
        return {name: option.default for name, option in self.options.items()}

    @classmethod
    def of(cls, values: Mapping[str, Any]) -> Self:
        """Make a record of those of some values that it has a field for."""
        return cls(**{name: values[name] for name in cls.options if name in values})

    def is_given(self, name: str) -> bool:
        """Return whether a field was given a value."""
        return name in self._given

    def replace(self, **changes: Any) -> Self:
        """Return a record with other values in some fields; None stands for the default."""
        return type(self)(**self._given | changes)

    def plain(self) -> dict[str, Any]:
        """Return all values as JSON has them, by their names in the report."""
        return {option.key: option.plain(getattr(self, name)) for name, option in self.options.items()}

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"{type(self).__name__} is frozen; replace({name}=...) makes a changed copy")

    def _values(self) -> tuple[Any, ...]:
        return tuple(getattr(self, name) for name in self.options)

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and self._values() == other._values()

    def __hash__(self) -> int:
        return hash(self._values())

    def __repr__(self) -> str:
        given = (f"{name}={getattr(self, name)!r}" for name in self.options if name in self._given)
        return f"{type(self).__name__}({', '.join(given)})"
