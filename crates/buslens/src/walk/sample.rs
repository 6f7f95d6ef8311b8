use super::{Algorithm, Items, Part, Telegram, Walk, Walker};
use crate::field::Spec;

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

impl Walker for Sampler<'_> {
    fn number(&mut self, spec: &'static Spec, width: usize, raw: &mut u64) -> Walk {
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
