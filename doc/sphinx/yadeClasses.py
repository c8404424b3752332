# SPDX-License-Identifier: GPL-2.0-or-later
# What YADE's Python wrapper says about a class: its text, attributes with type, default and flags, and methods. YADE keeps the latter three in roles at the
# end of an attribute's docstring and lets Boost.Python write signatures; here both are taken apart. tests/yade/testDocs.py reads the classes through it too.
"""Classes of YADE as records, and as pages in reST."""

import re
from typing import NamedTuple

#: Bits of `:yattrflags:` that say something to a user.
flagWords = {1: "not saved", 2: "read only"}

# Static attributes (of classes that draw) have no docstring of their own: YADE appends what is said of them to that of the class.
_static = re.compile(r"^\.\. ystaticattr:: \w+\.(\w+)\(=(.*?)\)\s*\n\n\t(.*?)(?=^\.\. ystaticattr::|\Z)", re.M | re.S)

_role = re.compile(r"\s*:(ydefault|yattrtype|yattrflags):`([^`]*)`")
_signature = re.compile(r"^(\w+)\((.*)\) -> (\w+) :$")
_argument = re.compile(r"\((\w+)\)(\w+)(=[^],]*)?")



class Attribute(NamedTuple):
	"""An attribute of a class of YADE.

	:param name: its name
	:param text: what it is, in reST
	:param type: in C++, or in Python for a static one; empty for a property that is computed when asked
	:param default: as YADE writes it; empty: none
	:param flags: words such as 'read only'
	"""

	name: str
	text: str
	type: str
	default: str
	flags: tuple


class Method(NamedTuple):
	"""A method of a class of YADE.

	:param name: its name
	:param arguments: texts such as 'young: float' or "element: str = 'full'", without the object itself
	:param returns: type
	:param static: True for one that is called on the class
	:param text: what it does, in reST
	"""

	name: str
	arguments: tuple
	returns: str
	static: bool
	text: str


def textOf(cls):
	"""What is said of a class as a whole, in reST."""
	return (cls.__doc__ or "").split("\n\n.. ystaticattr::")[0]


def attributesOf(cls):
	"""Attributes that a class adds to those of its base, in the order of their declaration."""
	static = {name: (default, text) for name, default, text in _static.findall(cls.__doc__ or "")}
	return [
	        _staticAttribute(cls, name, *static[name]) if name in static else _attribute(name, member.__doc__ or "") for name, member in _own(cls)
	        if isinstance(member, property)
	]


def methodsOf(cls):
	"""Methods that a class adds to those of its base, likewise."""
	return [_method(name, getattr(cls, name).__doc__ or "", isinstance(member, staticmethod)) for name, member in _own(cls) if not isinstance(member, property)]


def _own(cls):
	return [(name, member) for name, member in vars(cls).items() if not name.startswith("_")]


def _attribute(name, documentation):
	marks = dict(_role.findall(documentation))
	flags = int(marks.get("yattrflags") or 0)
	words = tuple(word for bit, word in flagWords.items() if flags & bit)
	if not marks:
		words = ("read only", )
	return Attribute(name, _role.sub("", documentation).strip(), marks.get("yattrtype", ""), marks.get("ydefault", ""), words)


def _staticAttribute(cls, name, default, documentation):
	"""As it is now, since YADE says no type of these; the word says that it is one for all objects."""
	found = _attribute(name, documentation)
	flags = found.flags if ":yattrflags:" in documentation else ()
	return found._replace(type=type(getattr(cls, name)).__name__, default=default, flags=("static", *flags))


def _method(name, documentation, static):
	lines = documentation.strip().splitlines() or [""]
	found = _signature.match(lines[0].strip())
	if not found:
		return Method(name, (), "object", static, documentation.strip())
	arguments = [_argumentText(*part) for part in _argument.findall(found.group(2))]
	if not static:
		arguments = arguments[1:]  # Boost.Python names the object itself
	return Method(name, tuple(arguments), found.group(3), static, "\n".join(line.strip() for line in lines[1:]).strip())


def _argumentText(type, name, default):
	return f"{name}: {type}" + (f" = {default[1:]}" if default else "")


# Pages


def page(cls):
	"""A page in reST about a class: base, text, attributes, methods, what it inherits."""
	name, base = cls.__name__, cls.__bases__[0].__name__
	parts = [f"{name}\n{'=' * len(name)}", f".. py:class:: {name}(attribute=value, ...)", f"   Base: :yref:`{base}`.", _indented(textOf(cls))]
	parts += [_attributeText(attribute) for attribute in attributesOf(cls)]
	parts += [_methodText(method) for method in methodsOf(cls)]
	parts += [_inherited(cls)]
	return "\n\n".join(part for part in parts if part) + "\n"


def _indented(text, by="   "):
	return "\n".join(by + line if line.strip() else "" for line in text.splitlines())


def _attributeText(attribute):
	options = [f"      :type: {_typeText(attribute.type)}"] if attribute.type else []
	if attribute.default:
		options.append(f"      :value: {attribute.default}")
	flags = f" *({', '.join(attribute.flags)})*" if attribute.flags else ""
	return "\n".join([f"   .. py:attribute:: {attribute.name}", *options, "", _indented(attribute.text + flags, "      ")])


def _typeText(type):
	"""A C++ type without the name spaces that a user of Python does not meet."""
	return type.replace("shared_ptr<", "").rstrip(">") if type.startswith("shared_ptr<") else type


def _methodText(method):
	kind = "      :staticmethod:\n" if method.static else ""
	head = f"   .. py:method:: {method.name}({', '.join(method.arguments)}) -> {method.returns}\n"
	return head + kind + "\n" + _indented(method.text, "      ")


def _inherited(cls):
	"""Names of what the class has from YADE's own, each with a link to YADE's documentation."""
	lines = []
	for base in cls.__mro__[1:]:
		if base.__name__ == "Serializable":
			break
		names = [attribute.name for attribute in attributesOf(base) if not attribute.name.startswith("disp")]  # of YADE's dispatching
		if names:
			lines.append(f"   - from :yref:`{base.__name__}`: " + ", ".join(f":yref:`{name}<{base.__name__}.{name}>`" for name in names))
	return "   Inherited attributes:\n\n" + "\n".join(lines) if lines else ""
