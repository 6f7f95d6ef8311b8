//! A module with its functions in another order. Nobody reads them in any, but compressors do: gzip remembers
//! 32 kB and finds what it had there. So those that are like each other stand side by side, which makes the
//! parts of the page smaller by a sixteenth.

use std::cmp::Reverse;
use std::collections::{HashMap, HashSet};

use wasm_encoder::reencode::{Error, Reencode};
use wasm_encoder::{CodeSection, FunctionSection, Module};
use wasmparser::{
    CodeSectionReader, CustomSectionReader, FunctionBody, FunctionSectionReader, Parser, Payload, TypeRef,
};

/// The module with like functions side by side, where it is to be packed, and without names of functions and the
/// like.
pub fn ordered(wasm: &[u8], is_packed: bool) -> Result<Vec<u8>, String> {
    let says = |error: String| format!("A part of the module is no wasm: {error}.");
    let mut order = Order::of(wasm, is_packed).map_err(|error| says(error.to_string()))?;
    let mut module = Module::new();
    order.parse_core_module(&mut module, Parser::new(0), wasm).map_err(|error| says(error.to_string()))?;
    Ok(module.finish())
}

/// Where functions go to.
struct Order {
    /// So many come from outside, and stay before all others.
    imported: usize,
    /// The others in their new order, by their place in the old one.
    order: Vec<usize>,
    /// The new place of each.
    places: Vec<usize>,
}

impl Order {
    fn of(wasm: &[u8], is_packed: bool) -> Result<Self, wasmparser::BinaryReaderError> {
        let (mut imported, mut types, mut bodies) = (0, Vec::new(), Vec::new());
        for payload in Parser::new(0).parse_all(wasm) {
            match payload? {
                Payload::ImportSection(section) => {
                    for import in section.into_imports() {
                        imported += usize::from(matches!(import?.ty, TypeRef::Func(_)));
                    }
                }
                Payload::FunctionSection(section) => types = section.into_iter().collect::<Result<_, _>>()?,
                Payload::CodeSectionEntry(body) => bodies.push(body),
                _ => {}
            }
        }
        // This takes some seconds.
        let order = if is_packed { by_likeness(&types, &bodies) } else { (0..bodies.len()).collect() };
        let mut places = vec![0; order.len()];
        order.iter().enumerate().for_each(|(place, function)| places[*function] = place);
        Ok(Self { imported, order, places })
    }
}

/// Each function behind the one that it has most in common with, of those that are left: as runs of bytes that stand in
/// both. The same source, compiled for other types, gives such functions.
fn by_likeness(types: &[u32], bodies: &[FunctionBody]) -> Vec<usize> {
    /// Found by trying: shorter runs stand everywhere, and so do those of more functions.
    const RUN: usize = 5;
    const MOST: usize = 500;
    let runs: Vec<HashSet<&[u8]>> =
        bodies.iter().map(|body| body.as_bytes().windows(RUN).collect()).collect();
    let mut holders: HashMap<&[u8], Vec<usize>> = HashMap::new();
    for (function, runs) in runs.iter().enumerate() {
        runs.iter().for_each(|run| holders.entry(run).or_default().push(function));
    }
    holders.retain(|_, functions| (2..=MOST).contains(&functions.len()));
    // Where nothing is like the last one, it goes on with the next of these.
    let mut rest: Vec<usize> = (0..bodies.len()).collect();
    rest.sort_by_key(|function| (types[*function], bodies[*function].as_bytes().len()));
    let mut rest = rest.into_iter();
    let mut is_left = vec![true; bodies.len()];
    let mut order = Vec::with_capacity(bodies.len());
    let mut shared = vec![0_usize; bodies.len()];
    while let Some(start) = rest.find(|function| is_left[*function]) {
        let mut next = Some(start);
        while let Some(function) = next {
            is_left[function] = false;
            order.push(function);
            let mut met = Vec::new();
            for other in runs[function].iter().filter_map(|run| holders.get(run)).flatten() {
                if is_left[*other] {
                    if shared[*other] == 0 {
                        met.push(*other);
                    }
                    shared[*other] += 1;
                }
            }
            // The share of what stands in both in what stands in either; the first one of those that are as like.
            let likeness = |other: &usize| {
                let both = shared[*other] as f64;
                let either = (runs[function].len() + runs[*other].len()) as f64 - both;
                if types[function] == types[*other] { 1.3 * both / either } else { both / either }
            };
            let best = met.iter().map(|other| (likeness(other), Reverse(*other)));
            next = best
                .max_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)))
                .map(|best| best.1.0);
            met.into_iter().for_each(|other| shared[other] = 0);
        }
    }
    order
}

impl Reencode for Order {
    type Error = std::convert::Infallible;

    fn function_index(&mut self, function: u32) -> Result<u32, Error> {
        let place = (function as usize).checked_sub(self.imported).and_then(|at| self.places.get(at));
        Ok(place.map_or(function, |place| (self.imported + place) as u32))
    }

    fn parse_function_section(
        &mut self,
        functions: &mut FunctionSection,
        section: FunctionSectionReader,
    ) -> Result<(), Error> {
        let types = section.into_iter().collect::<Result<Vec<_>, _>>()?;
        for function in &self.order {
            functions.function(types[*function]);
        }
        Ok(())
    }

    fn parse_code_section(
        &mut self,
        code: &mut CodeSection,
        section: CodeSectionReader,
    ) -> Result<(), Error> {
        let bodies = section.into_iter().collect::<Result<Vec<_>, _>>()?;
        let order = self.order.clone();
        order.into_iter().try_for_each(|function| self.parse_function_body(code, bodies[function].clone()))
    }

    fn parse_custom_section(&mut self, _: &mut Module, _: CustomSectionReader) -> Result<(), Error> {
        Ok(())
    }
}
