use super::{Algorithm, Deviation, Deviations, Items, Part, Path, Telegram, WINDOW, Walk, Walker};
use crate::field::Spec;

/// The bytes of `telegram`, with what `deviations` say to be otherwise.
pub fn write(telegram: &mut dyn Telegram, deviations: &Deviations) -> Vec<u8> {
    run(telegram, deviations).bytes
}

/// The first computed number of `telegram` that its bytes cannot hold: a count of more than it can count.
pub fn overflow(telegram: &mut dyn Telegram, deviations: &Deviations) -> Option<Overflow> {
    run(telegram, deviations).overflow
}

/// A computed number that is larger than its bytes can say.
#[derive(Clone, Debug, PartialEq)]
pub struct Overflow {
    pub spec: &'static Spec,
    /// The field's place in the telegram, as a form's entry has it.
    pub path: String,
    pub number: u64,
    /// The largest that the bytes can say.
    pub widest: u64,
}

/// The computed numbers of `telegram` as they would be without the deviation of their own field
/// (but with all others).
pub(super) fn compute(telegram: &mut dyn Telegram, deviations: &Deviations) -> Deviations {
    run(telegram, deviations).computed
}

fn run<'a>(telegram: &mut dyn Telegram, deviations: &'a Deviations) -> Writer<'a> {
    let mut writer = Writer {
        bytes: Vec::new(),
        path: Path::default(),
        deviations,
        computed: Deviations::default(),
        overflow: None,
    };
    // The writer never stops a walk.
    let _ = telegram.walk(&mut writer);
    writer.close_window(0, "");
    writer
}

struct Writer<'a> {
    bytes: Vec<u8>,
    path: Path,
    deviations: &'a Deviations,
    computed: Deviations,
    overflow: Option<Overflow>,
}

impl Writer<'_> {
    fn put(&mut self, spec: &'static Spec, width: usize, raw: u64) {
        self.bytes.extend(spec.order.bytes(raw, width));
    }

    fn put_computed(&mut self, spec: &'static Spec, width: usize, raw: u64) {
        let path = self.path.join(spec.key);
        let (widest, deviation) = (u64::MAX >> (64 - 8 * width), self.deviations.value(&path));
        self.put(spec, width, deviation.unwrap_or(raw));
        if raw > widest && deviation.is_none() && self.overflow.is_none() {
            self.overflow = Some(Overflow { spec, path: path.clone(), number: raw, widest });
        }
        self.computed.set(path, Deviation::Value(raw));
    }

    /// Ends a window that began at `from`.
    fn close_window(&mut self, from: usize, path: &str) {
        match self.deviations.get(path) {
            Some(Deviation::Extra(extra)) => self.bytes.extend_from_slice(extra),
            Some(Deviation::Cut(length)) => self.bytes.truncate(from + length),
            Some(Deviation::Value(_)) | None => {}
        }
    }
}

impl Walker for Writer<'_> {
    fn number(&mut self, spec: &'static Spec, width: usize, raw: &mut u64) -> Walk {
        self.put(spec, width, *raw);
        Ok(())
    }

    fn select(
        &mut self,
        spec: &'static Spec,
        width: usize,
        raw: &mut u64,
        _: &dyn Fn(u64) -> &'static Spec,
    ) -> Walk {
        self.put(spec, width, *raw);
        Ok(())
    }

    fn announce(&mut self, spec: &'static Spec, width: usize, items: usize, size: usize) -> Walk<usize> {
        self.put_computed(spec, width, (items * size) as u64);
        Ok(items)
    }

    fn derived(&mut self, spec: &'static Spec, width: usize, expected: Option<u64>) -> Walk {
        self.put_computed(spec, width, expected.unwrap_or(0));
        Ok(())
    }

    fn bytes(&mut self, _: &'static Spec, bytes: &mut Vec<u8>, _: Option<usize>) -> Walk {
        self.bytes.extend_from_slice(bytes);
        Ok(())
    }

    fn items(
        &mut self,
        spec: &'static Spec,
        items: &mut dyn Items,
        _: Option<usize>,
        _: Option<u64>,
    ) -> Walk {
        let depth = self.path.enter(spec.key);
        for index in 0..items.len() {
            let depth = self.path.enter_item(index);
            items.walk(index, self)?;
            self.path.leave(depth);
        }
        self.path.leave(depth);
        Ok(())
    }

    fn within(&mut self, spec: &'static Spec, part: Part<'_>) -> Walk {
        let depth = self.path.enter(spec.key);
        part(self)?;
        self.path.leave(depth);
        Ok(())
    }

    fn window(&mut self, _: usize, part: Part<'_>) -> Walk {
        let from = self.bytes.len();
        part(self)?;
        let path = self.path.join(WINDOW);
        self.close_window(from, &path);
        Ok(())
    }

    fn checksum(&mut self, spec: &'static Spec, algorithm: &'static Algorithm, from: usize) -> Walk {
        let check = algorithm.wire(&self.bytes[from..]);
        self.put_computed(spec, algorithm.width, check);
        Ok(())
    }

    fn ahead(&mut self, _: usize, part: Part<'_>) -> Option<u64> {
        let from = self.bytes.len();
        let (computed, overflow) = (self.computed.clone(), self.overflow.clone());
        let walk = part(self);
        let length = self.bytes.len() - from;
        self.bytes.truncate(from);
        (self.computed, self.overflow) = (computed, overflow);
        walk.ok().map(|()| length as u64)
    }

    fn mark(&self) -> usize {
        self.bytes.len()
    }
}
