use super::{Algorithm, Items, Part, Telegram, Walk, Walker};
use crate::field::{Name, Range, Spec};

/// Fills `telegram` with random values that keep the limits of their fields.
///
/// `random(n)` gives a number from 0 to `n`, both included. Lists get as many items as their
/// count's limits allow, at most eight where there is no limit.
pub fn sample(telegram: &mut dyn Telegram, random: &mut dyn FnMut(u64) -> u64) {
    // The sampler never stops a walk.
    let _ = telegram.walk(&mut Sampler { random });
}

/// Items of a list, or bytes, whose number nothing limits.
const LONGEST: u64 = 8;

struct Sampler<'a> {
    random: &'a mut dyn FnMut(u64) -> u64,
}

impl Sampler<'_> {
    fn between(&mut self, (from, to): (u64, u64)) -> u64 {
        from + (self.random)(to - from)
    }
}

impl Sampler<'_> {
    /// One of the values that the manual defines, where it defines all.
    fn named(&mut self, spec: &'static Spec) -> u64 {
        let one_of = |sampler: &mut Self, names: &'static [Name], ranges: &'static [Range]| {
            let values = names.iter().map(|name| name.value).chain(ranges.iter().map(|range| range.from));
            let values: Vec<u64> = values.collect();
            let drawn = sampler.between((0, values.len().saturating_sub(1) as u64)) as usize;
            values.get(drawn).copied()
        };
        if spec.bits.is_empty() {
            return one_of(self, spec.names, spec.ranges).unwrap_or_default();
        }
        spec.bits.iter().filter(|part| !part.reserved).fold(0, |raw, part| {
            let value = one_of(self, part.names, part.ranges);
            let value = value.unwrap_or_else(|| self.between((0, part.of(u64::MAX))));
            part.put(raw, value)
        })
    }
}

impl Walker for Sampler<'_> {
    fn number(&mut self, spec: &'static Spec, width: usize, raw: &mut u64) -> Walk {
        if spec.only_named {
            *raw = self.named(spec);
            return Ok(());
        }
        let widest = u64::MAX >> (64 - 8 * width);
        let drawn = self.between(spec.limits.unwrap_or((0, widest)));
        *raw = spec.bits.iter().filter(|part| part.reserved).fold(drawn, |raw, part| part.put(raw, 0));
        Ok(())
    }

    fn select(&mut self, _: &'static Spec, _: usize, _: &mut u64, _: &dyn Fn(u64) -> &'static Spec) -> Walk {
        Ok(())
    }

    fn announce(&mut self, spec: &'static Spec, _: usize, _: usize, size: usize) -> Walk<usize> {
        let size = size as u64;
        let (from, to) = spec.limits.unwrap_or((0, LONGEST * size));
        Ok(self.between((from.div_ceil(size), to / size)) as usize)
    }

    fn derived(&mut self, _: &'static Spec, _: usize, _: Option<u64>) -> Walk {
        Ok(())
    }

    fn bytes(&mut self, _: &'static Spec, bytes: &mut Vec<u8>, count: Option<usize>) -> Walk {
        let length = count.unwrap_or_else(|| self.between((0, LONGEST)) as usize);
        bytes.resize_with(length, || (self.random)(255) as u8);
        Ok(())
    }

    fn items(
        &mut self,
        _: &'static Spec,
        items: &mut dyn Items,
        count: Option<usize>,
        _: Option<u64>,
    ) -> Walk {
        items.resize(count.unwrap_or(items.len()));
        (0..items.len()).try_for_each(|index| items.walk(index, self))
    }

    fn within(&mut self, _: &'static Spec, part: Part<'_>) -> Walk {
        part(self)
    }

    fn window(&mut self, _: usize, part: Part<'_>) -> Walk {
        part(self)
    }

    fn checksum(&mut self, _: &'static Spec, _: &'static Algorithm, _: usize) -> Walk {
        Ok(())
    }
}
