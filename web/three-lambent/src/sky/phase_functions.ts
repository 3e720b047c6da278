// Phase functions, 1/sr, for the cosine between the directions of travel before and after: those of
// media::evaluate.

export const rayleighPhase = (cosine: number): number =>
  (3 / (16 * Math.PI)) * (1 + cosine * cosine);

export function cornetteShanks(g: number, cosine: number): number {
  const reach = 1 + g * g - 2 * g * cosine;
  return (
    ((3 / (8 * Math.PI)) * (1 - g * g) * (1 + cosine * cosine)) /
    ((2 + g * g) * reach * Math.sqrt(reach))
  );
}
