use super::{
    Algorithm, Deviation, Deviations, Items, Part, Path, Stop, Telegram, WINDOW, Walk, Walker, write,
};
use crate::field::{
    Argument, Check, Field, Format, Message, Numbering, Problem, Role, Severity, Span, Spec, Value, escaped,
    number_text,
};
use crate::message;

/// Reads `bytes` into `telegram` and returns the tree of its fields.
///
/// Never fails. Each byte is in exactly one leaf of the tree; what no field claims is in a leaf
/// [`UNEXPECTED`], and what is missing is a [`Value::Missing`] and a problem.
pub fn read(telegram: &mut dyn Telegram, bytes: &[u8]) -> Reading {
    /// Hardly a telegram has more fields beside each other, but for lists.
    const USUAL: usize = 6;
    let reader = Reader { keeps: true, fields: Vec::with_capacity(USUAL), ..Reader::new(bytes) };
    reader.read(telegram)
}

/// Reads `bytes` into `telegram` in the same way, and keeps nothing besides.
pub fn fill(telegram: &mut dyn Telegram, bytes: &[u8]) {
    Reader::new(bytes).read(telegram);
}

/// What reading a telegram gave, besides the value.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    pub fields: Vec<Field>,
    wire: Deviations,
}

impl Reading {
    /// In what the bytes deviate from what `telegram`, the value just read, implies: writing it
    /// with these gives the same bytes again.
    pub fn deviations(mut self, telegram: &mut dyn Telegram) -> Deviations {
        let computed = write::compute(telegram, &self.wire);
        self.wire.retain(|path, deviation| match deviation {
            Deviation::Value(found) => computed.value(path) != Some(*found),
            Deviation::Extra(_) | Deviation::Cut(_) => true,
        });
        self.wire
    }
}

/// Bytes after the last field of a telegram or of an envelope's payload.
pub static UNEXPECTED: Spec = Spec::new("unexpected", "Unexpected bytes")
    .short("Unexpected")
    .role(Role::Unknown)
    .note("These bytes come after the last field that the telegram has by its function code and counts.");

struct Reader<'a> {
    bytes: &'a [u8],
    /// Fields and deviations are wanted.
    keeps: bool,
    position: usize,
    /// Where the present window ends.
    end: usize,
    /// The fields of the present level.
    fields: Vec<Field>,
    path: Path,
    /// All computed numbers as they are on the wire, and what windows have too much or too little.
    wire: Deviations,
}

impl<'a> Reader<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        Self {
            bytes,
            keeps: false,
            position: 0,
            end: bytes.len(),
            fields: Vec::new(),
            path: Path::default(),
            wire: Deviations::default(),
        }
    }

    fn read(mut self, telegram: &mut dyn Telegram) -> Reading {
        let walk = telegram.walk(&mut self);
        self.close_window(walk, 0, "");
        Reading { fields: self.fields, wire: self.wire }
    }

    fn keep(&mut self, field: Field) {
        if self.keeps {
            self.fields.push(field);
        }
    }

    /// Notes what is on the wire for the `key` of the present level.
    fn note(&mut self, key: &str, deviation: Deviation) {
        if self.keeps {
            self.wire.set(self.path.join(key), deviation);
        }
    }

    /// Takes a number; if its bytes are not all there, leaves a missing field and stops.
    fn take(&mut self, spec: &'static Spec, width: usize, raw: &mut u64) -> Walk {
        let from = self.position;
        let found = width.min(self.end - from);
        self.position = from + found;
        let span = Span::new(from, self.position);
        let there = span.of(self.bytes);
        if found == width {
            *raw = spec.order.number(there);
            self.keep(Field::new(spec, span, Value::Number { raw: *raw, width }));
            return Ok(());
        }
        // Absent bytes count as zero, so that writing and cutting gives the same bytes.
        let mut bytes = there.to_vec();
        bytes.resize(width, 0);
        *raw = spec.order.number(&bytes);
        self.keep(Field::new(spec, span, Value::Missing { width, found }));
        self.cut_off(spec, width, found);
        Err(Stop)
    }

    /// Says of the field just read that only `found` of its `width` bytes are there.
    fn cut_off(&mut self, spec: &'static Spec, width: usize, found: usize) {
        let label = Argument::Term(spec.label);
        let message = match found {
            0 => message!(
                "{label} is missing: {bytes} more expected",
                label = label,
                bytes = Message::bytes(width)
            ),
            _ => message!(
                "{label} is cut off: {found} of its {bytes} are there",
                label = label,
                found = found,
                bytes = Message::bytes(width)
            ),
        };
        self.problem(Problem::error("truncated", self.last_span(), message));
    }

    fn problem(&mut self, problem: Problem) {
        if let Some(field) = self.fields.last_mut() {
            field.problems.push(problem);
        }
    }

    /// The span of the field just read.
    fn last_span(&self) -> Span {
        self.fields.last().map_or(Span::new(self.position, self.position), |field| field.span)
    }

    /// Limits, and bits that must be 0.
    fn check_limits(&mut self, spec: &'static Spec, raw: u64) {
        for part in spec.bits.iter().filter(|part| part.reserved && part.of(raw) != 0) {
            let (label, from, to) = (Argument::Term(spec.label), part.from, part.from + part.count - 1);
            let message = match part.count {
                1 => message!("{label}: bit {n} is reserved and should be 0", label = label, n = from),
                _ => message!(
                    "{label}: bits {from} to {to} are reserved and should be 0",
                    label = label,
                    from = from,
                    to = to
                ),
            };
            self.problem(Problem::warning("reserved-bits", self.last_span(), message));
        }
        if !spec.defines(raw) {
            let (label, raw) = (Argument::Term(spec.label), self.shown(spec, raw));
            let message = message!("{label}: the manual does not define {raw}", label = label, raw = raw);
            self.problem(Problem::warning("not-defined", self.last_span(), message));
        }
        if let Some(wrong) = spec.rule.and_then(|rule| rule(raw)) {
            let (label, wrong) = (Argument::Term(spec.label), Argument::Term(wrong));
            let message = message!("{label}: {wrong}", label = label, wrong = wrong);
            self.problem(Problem::error("not-allowed", self.last_span(), message));
        }
        if let (false, Some((from, to))) = (spec.allows(raw), spec.limits) {
            let (label, raw, to) = (Argument::Term(spec.label), self.shown(spec, raw), self.shown(spec, to));
            let message = match spec.limits {
                Some((only, most)) if only == most => {
                    message!("{label} is {raw}; only {to} is allowed", label = label, raw = raw, to = to)
                }
                _ => message!(
                    "{label} is {raw}; {from} to {to} are allowed",
                    label = label,
                    raw = raw,
                    from = self.shown(spec, from),
                    to = to
                ),
            };
            self.problem(Problem::error("out-of-range", self.last_span(), message));
        }
    }

    /// A number as the field just read shows its own.
    fn shown(&self, spec: &'static Spec, raw: u64) -> String {
        number_text(raw, self.last_span().len(), spec.format)
    }

    /// Takes a number that other things of the telegram determine, and notes it by its path.
    fn take_computed(&mut self, spec: &'static Spec, width: usize) -> Walk<u64> {
        let mut raw = 0;
        let walk = self.take(spec, width, &mut raw);
        self.note(spec.key, Deviation::Value(raw));
        walk.map(|()| raw)
    }

    /// Reads one level down and puts what was read under a field of its own.
    fn group(&mut self, spec: &'static Spec, part: impl FnOnce(&mut Self) -> Walk) -> Walk {
        let from = self.position;
        let outer = std::mem::take(&mut self.fields);
        let depth = self.path.enter(spec.key);
        let walk = part(self);
        self.path.leave(depth);
        let children = std::mem::replace(&mut self.fields, outer);
        let mut field = Field::new(spec, Span::new(from, self.position), Value::Group);
        field.children = children;
        self.keep(field);
        walk
    }

    /// Ends the window of this `key` that began at `from`: what is left in it becomes an unexpected field.
    fn close_window(&mut self, walk: Walk, from: usize, key: &str) {
        let left = Span::new(self.position, self.end);
        if !left.is_empty() {
            self.position = self.end;
            let mut field = Field::new(&UNEXPECTED, left, Value::Bytes);
            field.problems.push(Problem::error(
                "unexpected-bytes",
                left,
                message!("{bytes} too many", bytes = Message::bytes(left.len())),
            ));
            self.keep(field);
            self.note(key, Deviation::Extra(left.of(self.bytes).to_vec()));
        } else if walk.is_err() {
            self.note(key, Deviation::Cut(self.end - from));
        }
    }
}

impl Walker for Reader<'_> {
    fn number(&mut self, spec: &'static Spec, width: usize, raw: &mut u64) -> Walk {
        self.take(spec, width, raw)?;
        self.check_limits(spec, *raw);
        Ok(())
    }

    fn select(
        &mut self,
        spec: &'static Spec,
        width: usize,
        raw: &mut u64,
        choices: &dyn Fn(u64) -> &'static Spec,
    ) -> Walk {
        self.take(spec, width, raw)?;
        if let Some(field) = self.fields.last_mut() {
            field.value = Value::Selector { raw: *raw, width, chosen: choices(*raw) };
        }
        Ok(())
    }

    fn announce(&mut self, spec: &'static Spec, width: usize, _: usize, size: usize) -> Walk<usize> {
        let raw = self.take_computed(spec, width)?;
        self.check_limits(spec, raw);
        let size = size as u64;
        if !raw.is_multiple_of(size) {
            let message = message!(
                "{label} is {raw}, which is not a multiple of {size}",
                label = Argument::Term(spec.label),
                raw = raw,
                size = size
            );
            self.problem(Problem::error("not-a-multiple", self.last_span(), message));
        }
        Ok(usize::try_from(raw / size).unwrap_or(usize::MAX))
    }

    fn derived(&mut self, spec: &'static Spec, width: usize, expected: Option<u64>) -> Walk {
        let raw = self.take_computed(spec, width)?;
        if let Some(expected) = expected
            && raw != expected
        {
            let message = message!(
                "{label} is {raw}; it must be {expected} here",
                label = Argument::Term(spec.label),
                raw = self.shown(spec, raw),
                expected = self.shown(spec, expected)
            );
            self.problem(Problem::error("count-mismatch", self.last_span(), message));
        }
        Ok(())
    }

    fn bytes(&mut self, spec: &'static Spec, bytes: &mut Vec<u8>, count: Option<usize>) -> Walk {
        let left = self.end - self.position;
        let wanted = count.unwrap_or(left);
        let span = Span::new(self.position, self.position + wanted.min(left));
        *bytes = span.of(self.bytes).to_vec();
        self.position = span.to;
        if wanted > 0 {
            let value = match spec.format {
                Format::Text => Value::Text(escaped(bytes)),
                _ => Value::Bytes,
            };
            self.keep(Field::new(spec, span, value));
        }
        if wanted > left {
            self.cut_off(spec, wanted, left);
            return Err(Stop);
        }
        Ok(())
    }

    fn items(
        &mut self,
        spec: &'static Spec,
        items: &mut dyn Items,
        count: Option<usize>,
        first: Option<u64>,
    ) -> Walk {
        let mut there = 0;
        let walk = self.group(spec, |reader| {
            // Grows with the bytes that are there, not with what is announced.
            items.resize(0);
            if reader.keeps {
                reader.fields.reserve(count.unwrap_or_default().min(reader.end - reader.position));
            }
            let more = |there, left: bool| match count {
                Some(count) => there < count && left,
                None => there == 0 || left,
            };
            while more(there, reader.position < reader.end) {
                items.resize(there + 1);
                let depth = reader.path.enter_item(there);
                let walk = items.walk(there, reader);
                reader.path.leave(depth);
                walk?;
                there += 1;
            }
            if count.is_some_and(|count| there < count) { Err(Stop) } else { Ok(()) }
        });
        let Some(list) = self.fields.last_mut() else { return walk };
        for (offset, item) in (0..).zip(&mut list.children) {
            item.number = Some(Numbering::new(first, offset * item.spec.step));
        }
        if let (true, Some(count)) = (walk.is_err(), count) {
            let message = message!(
                "{label}: {count} announced, {there} there; the telegram ends before the list does",
                label = Argument::Term(spec.label),
                count = count,
                there = there
            );
            list.problems.push(Problem::error("truncated", list.span, message));
        }
        walk
    }

    fn within(&mut self, spec: &'static Spec, part: Part<'_>) -> Walk {
        self.group(spec, |reader| part(reader))
    }

    fn window(&mut self, keep: usize, part: Part<'_>) -> Walk {
        let from = self.position;
        let outer = self.end;
        // Too short for a payload as long as what is kept: the bytes are the telegram's beginning.
        if outer - from >= 2 * keep {
            self.end = outer - keep;
        }
        let walk = part(self);
        self.close_window(walk, from, WINDOW);
        self.end = outer;
        Ok(())
    }

    fn checksum(&mut self, spec: &'static Spec, algorithm: &'static Algorithm, from: usize) -> Walk {
        let covered = Span::new(from, self.position);
        let found = self.take_computed(spec, algorithm.width)?;
        let check = Check {
            kind: algorithm.kind,
            width: algorithm.width,
            found,
            computed: algorithm.wire(covered.of(self.bytes)),
            low_first: algorithm.low_first,
            covered,
        };
        if !check.ok() {
            let message = message!(
                "{label} is wrong: {found} found, {computed} computed from the bytes before it",
                label = Argument::Term(spec.label),
                found = check.found_bytes(),
                computed = check.computed_bytes()
            );
            self.problem(Problem::error("check-failed", self.last_span(), message));
        }
        if let Some(field) = self.fields.last_mut() {
            field.value = Value::Check(check);
        }
        Ok(())
    }

    fn ahead(&mut self, around: usize, _: Part<'_>) -> Option<u64> {
        (self.end - self.position).checked_sub(around).map(|left| left as u64)
    }

    fn mark(&self) -> usize {
        self.position
    }

    fn remark(&mut self, spec: &'static Spec, severity: Severity, code: &'static str, message: Message) {
        if let Some(field) = self.fields.iter_mut().rev().find(|field| std::ptr::eq(field.spec, spec)) {
            field.problems.push(Problem { code, severity, message, span: field.span });
        }
    }
}
