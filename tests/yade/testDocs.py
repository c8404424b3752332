# SPDX-License-Identifier: GPL-2.0-or-later
# What help() says is complete: every class of ours in YADE with all attributes and methods, and every public function, class and method of the Python package,
# whichever are there when the test runs. Public is what the package itself has (yade_brick.brick) and what an example or a page of the documentation uses of a
# module (report.judgedRow). Each lack is listed, so that one run shows all.
import ast, importlib, inspect, os, pathlib, re, sys, textwrap, unittest

import yade_brick

repository = os.path.realpath(os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..'))
sys.path.insert(0, os.path.join(repository, 'doc', 'sphinx'))
import pythonModules, yadeClasses

classes = [getattr(yade_brick, name) for name in sorted(yade_brick._core.classes)]

# A number that has a dimension says its unit in brackets, [m]. One that has none says [-], or what it is in one of these words.
unit = re.compile(r'\[(-|[\w/ .^()*]+)\]')
noDimension = re.compile(
        r'\b(share|fraction|ratio|number|times|count|factor|direction|quaternion|index|indices|ids?|percent|colours?|degrees|pixels|inches|points)\b', re.I
)
numberTypes = re.compile(r'\b(Real|double|Vector\dr|Vector\d|Matrix\w+|Quaternionr|float)\b')

# Parameters of Python functions with a dimension, by the last word of their names.
dimensional = re.compile(
        r'(size|sizes|thickness|origin|cent(er|re)|corners?|span|rise|height|depth|length|width|radius|gap|overlap|displacement|verletdist'
        r'|dt|time|duration|period|until|every|interval|gravity|velocity|acceleration|force|stress|young|density|frequency)$', re.I)

# What a short text may call a parameter
otherWords = {'path': 'path|file|folder|CSV', 'id': 'id|body'}

# Attributes that Python finds in every NamedTuple, dataclass, list or tuple
inherited = {name for kind in (list, tuple, dict, Exception) for name in vars(kind)} | {'_fields', 'count', 'index'}


def isSentence(text):
	"""Begins with a capital (or code), ends with a full stop, and says more than the name."""
	text = text.strip()
	return len(text) >= 12 and text[:1] in '`:(\'"[' + text[:1].upper() and text.rstrip(')"\'').endswith(('.', ':', '::'))


def saysUnit(text):
	return bool(unit.search(text) or noDimension.search(text))


class YadeClasses(unittest.TestCase):

	def lacks(self, found):
		self.assertEqual(found, [], '\n' + '\n'.join(found))

	def test_classes_are_described(self):
		self.lacks([f'{c.__name__}: {c.__doc__!r}' for c in classes if not isSentence(yadeClasses.textOf(c)) or len(yadeClasses.textOf(c)) < 40])

	def test_static_attributes_are_seen(self):
		"""In one of YADE's own classes that draw, which keeps them elsewhere than others."""
		from yade import wrapper
		found = {a.name: a for a in yadeClasses.attributesOf(wrapper.Gl1_Sphere)}
		self.assertEqual((found['quality'].type, found['quality'].default, found['wire'].flags), ('float', '1.0', ('static', )))
		self.assertTrue(found['wire'].text.startswith('Only show wireframe'))
		self.assertEqual(yadeClasses.textOf(wrapper.Gl1_Sphere), 'Renders :yref:`Sphere` object')

	def test_attributes_and_methods_are_described(self):
		members = [(c, m) for c in classes for m in yadeClasses.attributesOf(c) + yadeClasses.methodsOf(c)]
		self.assertGreater(len(members), 80)  # or the test sees nothing: Brick alone has 20
		self.lacks([f'{c.__name__}.{m.name}: {m.text!r}' for c, m in members if not isSentence(m.text)])

	def test_attributes_that_are_numbers_have_a_unit(self):
		self.lacks([
		        f'{c.__name__}.{a.name} ({a.type}): {a.text}' for c in classes for a in yadeClasses.attributesOf(c)
		        if self.isNumber(c, a) and not saysUnit(a.text)
		])

	def test_methods_that_give_numbers_have_a_unit(self):
		self.lacks([
		        f'{c.__name__}.{m.name} -> {m.returns}: {m.text}' for c in classes for m in yadeClasses.methodsOf(c)
		        if m.returns not in ('None', 'bool', 'str', 'int') and not saysUnit(m.text)
		])

	def test_methods_name_their_arguments(self):
		wrong = re.compile(r'^arg\d+\b')
		self.lacks([f'{c.__name__}.{m.name}({", ".join(m.arguments)})' for c in classes for m in yadeClasses.methodsOf(c) if any(map(wrong.match, m.arguments))])

	def test_names_that_are_referred_to_exist(self):
		"""Of our own classes; YADE's are looked up in YADE."""
		texts = [(c.__name__, c.__doc__ or '') for c in classes]
		texts += [(f'{c.__name__}.{m.name}', m.text) for c in classes for m in yadeClasses.attributesOf(c) + yadeClasses.methodsOf(c)]
		targets = {(where, target) for where, text in texts for target in re.findall(r':yref:`(?:[^`<]*<)?([\w.]+)>?`', text)}
		self.assertGreater(len(targets), 30)
		self.lacks(sorted(f'{where} refers to {target}' for where, target in targets if not self.exists(target)))

	@staticmethod
	def exists(target):
		from yade import wrapper
		name, _, attribute = target.partition('.')
		cls = getattr(wrapper, name, None)
		return cls is not None and (not attribute or hasattr(cls, attribute))

	@staticmethod
	def isNumber(cls, attribute):
		if attribute.type:
			return bool(numberTypes.search(attribute.type))
		try:
			value = getattr(cls(), attribute.name)
		except Exception:  # a property that an object without a scene does not have
			return False
		return isinstance(value, float)


class PythonPackage(unittest.TestCase):

	@classmethod
	def setUpClass(cls):
		cls.things = list(publicThings())

	def lacks(self, found):
		self.assertEqual(found, [], '\n' + '\n'.join(found))

	def test_it_sees_the_package(self):
		names = {name for name, _, _ in self.things}
		for known in ('build.brick', 'loop.engines', 'motion.Motion', 'motion.Motion.resampled', 'report.judgedRow'):
			self.assertIn('yade_brick.' + known, names)
		exported = {f'{thing.__module__}.{thing.__qualname__}' for thing in pythonModules.functionsAndClasses(yade_brick).values()}
		self.assertLessEqual(exported, names)

	def test_all_are_described(self):
		self.lacks([f'{name}: {thing.__doc__!r}' for name, thing, _ in self.things if not isSentence(summary(thing))])

	def test_every_parameter_is_described(self):
		"""By :param p:, by the name in the text where there are one or two, or 'as in' another function that has it."""
		self.lacks([f'{name}: no :param {p}:' for name, thing, parameters in self.things for p in parameters if not isDescribed(p, thing, parameters)])

	def test_nothing_is_described_that_is_no_parameter(self):
		"""Nor, of a class, an attribute that its objects have."""
		self.lacks([
		        f'{name}: :param {p}: is none of its parameters' for name, thing, parameters in self.things for p in described(thing)
		        if p not in parameters and not (inspect.isclass(thing) and f'self.{p}' in inspect.getsource(thing))
		])

	def test_lengths_times_and_the_like_have_a_unit(self):
		self.lacks([
		        f'{name}: :param {p}: {text}' for name, thing, _ in self.things for p, text in described(thing).items()
		        if dimensional.search(p) and not saysUnit(text) and not text.startswith(('as in ', 'True', 'whether'))
		])

	def test_what_is_returned_is_said(self):
		"""By :returns:, unless the text is about that itself ('Present corners of a brick [m].') and not about what is done ('Reads ...')."""
		self.lacks([
		        f'{name}: no :returns:' for name, thing, parameters in self.things
		        if inspect.isfunction(thing) and givesSomething(thing)
		        and not re.search(':returns:|Returns ', thing.__doc__ or '') and re.match(r'[A-Z][a-z]+s\b', summary(thing))
		])


def publicThings():
	"""(full name, function or class, names of its parameters) of all that is public."""
	public = {f'{thing.__module__}.{thing.__qualname__}' for thing in pythonModules.functionsAndClasses(yade_brick).values()} | usedNames()
	for module in pythonModules.modulesOf(yade_brick):
		module = importlib.import_module('yade_brick.' + module)
		for name, thing in vars(module).items():
			full = f'{module.__name__}.{name}'
			if full not in public or getattr(thing, '__module__', None) != module.__name__:
				continue
			if inspect.isfunction(thing):
				yield full, thing, parametersOf(thing)
			elif inspect.isclass(thing):
				yield full, thing, [] if issubclass(thing, (list, tuple)) and not hasattr(thing, '_fields') else parametersOf(thing)
				yield from membersOf(full, thing)


def usedNames():
	"""Full names of what examples and pages use of modules, as report.judgedRow or `from yade_brick.picture import Patch`."""
	texts = []
	for pattern in ('examples/*.py', 'doc/**/*.md', 'README.md'):
		texts += [path.read_text() for path in pathlib.Path(repository).glob(pattern)]
	text = '\n'.join(texts)
	modules = '|'.join(pythonModules.modulesOf(yade_brick))
	found = {f'yade_brick.{module}.{name}' for module, name in re.findall(rf'\b({modules})\.(\w+)', text)}
	for module, names in re.findall(rf'from yade_brick\.({modules}) import ([\w, ]+)', text):
		found |= {f'yade_brick.{module}.{name.strip()}' for name in names.split(',')}
	return found


def membersOf(name, cls):
	for member, thing in vars(cls).items():
		if member.startswith('_') or member in inherited or member in getattr(cls, '_fields', ()):
			continue
		if isinstance(thing, property):
			yield f'{name}.{member}', thing, []
		elif isinstance(thing, (staticmethod, classmethod)) or inspect.isfunction(thing):
			yield f'{name}.{member}', getattr(thing, '__func__', thing), parametersOf(getattr(thing, '__func__', thing))


def parametersOf(thing):
	try:
		return [p for p in inspect.signature(thing).parameters if p not in ('self', 'cls')]
	except ValueError:  # classes that have no signature, such as enumerations
		return []


def summary(thing):
	return re.split(r'\n\s*\n', inspect.getdoc(thing) or '')[0].split('\n:')[0]


def described(thing):
	"""{parameter: its text}; one field may be about several: `:param courses, size: as in straightJointWall`."""
	fields = re.findall(r'^:param ([\w, *]+):(.*?)(?=^:\w|\Z)', inspect.getdoc(thing) or '', re.M | re.S)
	return {name.strip(' *'): text.strip() for names, text in fields for name in names.split(',')}


def isDescribed(parameter, thing, parameters):
	text = inspect.getdoc(thing) or ''
	if parameter in described(thing) or re.search(rf'; {parameter}: ', text):  # two in one field
		return True
	if parameter in ('x', 'y', 'z') and 'axis' in text:
		return True
	if len(parameters) <= 2 and re.search(rf'\b({otherWords.get(parameter, parameter)})\b', text):
		return True
	return any(parameter in parametersOf(other) for other in map(functionNamed, re.findall(r'\b(?:as in|and) `*(\w+)', text)) if other)


def functionNamed(name):
	"""The function or class of that name anywhere in the package, or None."""
	modules = [importlib.import_module('yade_brick.' + module) for module in pythonModules.modulesOf(yade_brick)]
	return next((found for module in modules if callable(found := getattr(module, name, None))), None)


def givesSomething(function):
	tree = ast.parse(textwrap.dedent(inspect.getsource(function)))
	return any(isinstance(node, ast.Return) and node.value is not None for node in ast.walk(tree))


class Overview(unittest.TestCase):
	"""The page that says at a glance what there is leaves nothing out."""

	def test_all_names_are_there(self):
		with open(os.path.join(repository, 'doc', 'guide', 'overview.md')) as file:
			named = set(re.findall(r'\w+', ' '.join(re.findall(r'`([^`]+)`', file.read()))))
		wanted = set(yade_brick._core.classes) | set(pythonModules.functionsAndClasses(yade_brick))
		self.assertEqual(sorted(wanted - named), [])
