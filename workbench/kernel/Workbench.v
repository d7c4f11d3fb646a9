(* What the exported certificates use: sums over n neurons, the sign function, the rules of the checker, each a lemma. *)
Require Import Reals Lra Lia.
Open Scope R_scope.

(* --- what statements are written with --- *)

(* f 0 + ... + f (n - 1): Sum(...) over an index, for any n, also none. *)
Fixpoint bigsum (n : nat) (f : nat -> R) : R :=
  match n with O => 0 | S m => bigsum m f + f m end.

Definition sgn (x : R) : R :=
  match total_order_T x 0 with inleft (left _) => -1 | inleft (right _) => 0 | inright _ => 1 end.

(* --- names for values --- *)

Lemma named : forall x : R, { y : R | y = x }.
Proof. intro x. exists x. reflexivity. Qed.

Lemma named_each : forall f : nat -> R, { g : nat -> R | forall i, g i = f i }.
Proof. intro f. exists f. reflexivity. Qed.

(* --- sums --- *)

Lemma bigsum_ext : forall n f g, (forall i, (i < n)%nat -> f i = g i) -> bigsum n f = bigsum n g.
Proof.
  intros n f g. induction n as [|n IH]; intros H; simpl; [reflexivity|].
  rewrite IH by (intros; apply H; lia). rewrite (H n) by lia. reflexivity.
Qed.

Lemma bigsum_scal : forall n c f, bigsum n (fun i => c * f i) = c * bigsum n f.
Proof. intros n c f. induction n as [|n IH]; simpl; [ring|]. rewrite IH. ring. Qed.

Lemma bigsum_plus : forall n f g, bigsum n (fun i => f i + g i) = bigsum n f + bigsum n g.
Proof. intros n f g. induction n as [|n IH]; simpl; [ring|]. rewrite IH. ring. Qed.

Lemma bigsum_zero : forall n f, (forall i, (i < n)%nat -> f i = 0) -> bigsum n f = 0.
Proof.
  intros n f. induction n as [|n IH]; intros H; simpl; [reflexivity|].
  rewrite IH by (intros; apply H; lia). rewrite (H n) by lia. ring.
Qed.

Lemma bigsum_nonneg : forall n f, (forall i, (i < n)%nat -> 0 <= f i) -> 0 <= bigsum n f.
Proof.
  intros n f. induction n as [|n IH]; intros H; simpl; [lra|].
  assert (0 <= bigsum n f) by (apply IH; intros; apply H; lia). assert (0 <= f n) by (apply H; lia). lra.
Qed.

(* a sum as weights times totals, one for each kind of term *)
Lemma no_terms : forall n, 0 = bigsum n (fun _ => 0).
Proof. intros. rewrite bigsum_zero by reflexivity. reflexivity. Qed.

Lemma linear_sum : forall n w t f r g, t = bigsum n f -> r = bigsum n g ->
  w * t + r = bigsum n (fun i => w * f i + g i).
Proof. intros n w t f r g -> ->. rewrite bigsum_plus, bigsum_scal. reflexivity. Qed.

(* --- relations and their margins --- *)

Lemma le_of : forall a b m, b - a = m -> m >= 0 -> a <= b. Proof. intros; lra. Qed.
Lemma lt_of : forall a b m, b - a = m -> m > 0 -> a < b. Proof. intros; lra. Qed.
Lemma ge_of : forall a b m, a - b = m -> m >= 0 -> a >= b. Proof. intros; lra. Qed.
Lemma gt_of : forall a b m, a - b = m -> m > 0 -> a > b. Proof. intros; lra. Qed.
Lemma eq_of : forall a b m, a - b = m -> m = 0 -> a = b. Proof. intros; lra. Qed.
Lemma ne_of : forall a b m, a - b = m -> m <> 0 -> a <> b. Proof. intros; lra. Qed.
Lemma le_margin : forall a b m, a <= b -> b - a = m -> m >= 0. Proof. intros; lra. Qed.
Lemma lt_margin : forall a b m, a < b -> b - a = m -> m > 0. Proof. intros; lra. Qed.
Lemma ge_margin : forall a b m, a >= b -> a - b = m -> m >= 0. Proof. intros; lra. Qed.
Lemma gt_margin : forall a b m, a > b -> a - b = m -> m > 0. Proof. intros; lra. Qed.
Lemma eq_margin : forall a b m, a = b -> a - b = m -> m = 0. Proof. intros; lra. Qed.
Lemma ne_margin : forall a b m, a <> b -> a - b = m -> m <> 0. Proof. intros; lra. Qed.

(* --- rule combination: scale * value = total --- *)

Lemma combination_ge : forall s v t, 0 < s -> 0 <= t -> s * v = t -> v >= 0.
Proof.
  intros s v t Hs Ht E. apply Rle_ge. apply (Rmult_le_reg_l s); [exact Hs|]. rewrite E, Rmult_0_r. exact Ht.
Qed.

Lemma combination_gt : forall s v t, 0 < s -> 0 < t -> s * v = t -> v > 0.
Proof. intros s v t Hs Ht E. apply (Rmult_lt_reg_l s); [exact Hs|]. rewrite E, Rmult_0_r. exact Ht. Qed.

Lemma combination_eq : forall s v t, 0 < s -> t = 0 -> s * v = t -> v = 0.
Proof.
  intros s v t Hs Ht E. rewrite Ht in E. destruct (Rmult_integral _ _ E) as [Z|Z]; [lra|exact Z].
Qed.

(* the same with a sum over an index: the two sides agree outside of the sum and in each of its terms *)
Lemma combined_sum : forall n s a f b g, s * a = b -> (forall i, (i < n)%nat -> s * f i = g i) ->
  s * (a + bigsum n f) = b + bigsum n g.
Proof.
  intros n s a f b g A B. rewrite Rmult_plus_distr_l, A, <- bigsum_scal. rewrite (bigsum_ext n _ g B). reflexivity.
Qed.

Lemma add_split : forall n x a f y b g, x = a + bigsum n f -> y = b + bigsum n g ->
  x + y = (a + b) + bigsum n (fun i => f i + g i).
Proof. intros. subst. rewrite bigsum_plus. ring. Qed.

Lemma scale_split : forall n c a f, c * (a + bigsum n f) = c * a + bigsum n (fun i => c * f i).
Proof. intros. rewrite bigsum_scal. ring. Qed.

(* two values with a sum agree, or are opposites, when what stands outside of the sum and each of its terms do *)
Lemma equal_sums : forall n a f b g, a = b -> (forall i, (i < n)%nat -> f i = g i) -> a + bigsum n f = b + bigsum n g.
Proof. intros n a f b g -> H. f_equal. apply bigsum_ext. exact H. Qed.

Lemma opposite_sums : forall n a f b g, a = - b -> (forall i, (i < n)%nat -> f i = - g i) ->
  a + bigsum n f = - (b + bigsum n g).
Proof.
  intros n a f b g -> H. rewrite (bigsum_ext n f (fun i => -1 * g i)); [rewrite bigsum_scal; ring|].
  intros i I. rewrite (H i I). ring.
Qed.

Lemma no_split : forall n x, x = x + bigsum n (fun _ => 0).
Proof. intros. rewrite bigsum_zero by reflexivity. ring. Qed.

(* --- signs of products --- *)

Lemma pos_ge : forall x, 0 < x -> 0 <= x. Proof. intros; lra. Qed.
Lemma gt_pos : forall x, x > 0 -> 0 < x. Proof. intros; lra. Qed.
Lemma ge_nonneg : forall x, x >= 0 -> 0 <= x. Proof. intros; lra. Qed.
Lemma eq_nonneg : forall x, x = 0 -> 0 <= x. Proof. intros; lra. Qed.
Lemma pos_ne : forall x, 0 < x -> x <> 0. Proof. intros; lra. Qed.
Lemma zero_last : forall a z, z = 0 -> a * z = 0. Proof. intros; subst; ring. Qed.
Lemma zero_first : forall a b, a = 0 -> a * b = 0. Proof. intros; subst; ring. Qed.
Lemma zero_plus : forall a b, a = 0 -> b = 0 -> a + b = 0. Proof. intros; subst; ring. Qed.
Lemma nothing : 0 >= 0. Proof. lra. Qed.
Lemma product_ne : forall a b, a <> 0 -> b <> 0 -> a * b <> 0.
Proof. intros a b A B E. destruct (Rmult_integral _ _ E); contradiction. Qed.
Lemma power_ne : forall a n, a <> 0 -> a ^ n <> 0. Proof. intros. apply pow_nonzero. assumption. Qed.
Lemma even_power : forall a n, 0 <= a ^ (2 * n). Proof. intros. rewrite pow_mult. apply pow_le, pow2_ge_0. Qed.
Lemma even_power_pos : forall a n, a <> 0 -> 0 < a ^ (2 * n).
Proof. intros. rewrite pow_mult. apply pow_lt. apply Rsqr_pos_lt in H. unfold Rsqr in H. simpl. lra. Qed.
Lemma square_nonneg : forall a, 0 <= a * a. Proof. intros. apply Rle_0_sqr. Qed.
Lemma square_pos : forall a, a <> 0 -> 0 < a * a. Proof. intros. apply Rsqr_pos_lt. assumption. Qed.
Lemma quotient_pos : forall a b, 0 < a -> 0 < b -> 0 < a / b.
Proof. intros. apply Rdiv_lt_0_compat; assumption. Qed.
Lemma quotient_nonneg : forall a b, 0 <= a -> 0 < b -> 0 <= a / b.
Proof. intros. apply Rmult_le_pos; [assumption|]. apply Rlt_le, Rinv_0_lt_compat. assumption. Qed.
Lemma quotient_ne : forall a b, a <> 0 -> b <> 0 -> a / b <> 0.
Proof. intros. apply product_ne; [assumption|]. apply Rinv_neq_0_compat. assumption. Qed.
Lemma inverse_pos : forall a, a > 0 -> 0 < / a. Proof. intros. apply Rinv_0_lt_compat. assumption. Qed.

(* --- facts --- *)

Lemma exp_tangent : forall x, 0 <= exp x - 1 - x.
Proof. intros x. destruct (Req_dec x 0) as [->|N]; [rewrite exp_0; lra|]. pose proof (exp_ineq1 x N). lra. Qed.

Lemma log_tangent : forall x, 0 < x -> 0 <= x - 1 - ln x.
Proof. intros x P. pose proof (exp_tangent (ln x)) as T. rewrite exp_ln in T by exact P. lra. Qed.

Lemma circle : forall x, sin x * sin x + cos x * cos x - 1 = 0.
Proof. intros x. pose proof (sin2_cos2 x) as C. unfold Rsqr in C. lra. Qed.

Lemma sine_tangent : forall x, 0 <= x -> 0 <= x - sin x.
Proof. intros x [P|<-]; [pose proof (sin_lt_x x P)|rewrite sin_0]; lra. Qed.

Lemma sine_square : forall x, 0 <= x -> sin x * sin x <= x * x.
Proof.
  intros x P. pose proof (sine_tangent x P) as T. assert (B : - x <= sin x).
  { destruct (Rle_or_lt x PI) as [L|G]; [pose proof (sin_ge_0 x P L); lra|].
    pose proof (SIN_bound x). pose proof PI2_1. lra. }
  replace (x * x) with (sin x * sin x + (x - sin x) * (x + sin x)) by ring.
  assert (0 <= (x - sin x) * (x + sin x)) by (apply Rmult_le_pos; lra). lra.
Qed.

Lemma cosine_parabola : forall x, 0 <= cos x - 1 + x * x * (1 / 2).
Proof.
  assert (H : forall x, 0 <= x -> 0 <= cos x - 1 + x * x * (1 / 2)).
  { intros x P. pose proof (sine_square (x / 2)) as S. pose proof (cos_2a_sin (x / 2)) as E.
    replace (2 * (x / 2)) with x in E by field. rewrite E. lra. }
  intros x. destruct (Rle_or_lt 0 x) as [P|N]; [exact (H x P)|].
  pose proof (H (- x)) as T. rewrite cos_neg in T. lra.
Qed.

Lemma sine_sum : forall a b s, s = a + b -> sin s - sin a * cos b - cos a * sin b = 0.
Proof. intros a b s ->. rewrite sin_plus. ring. Qed.
Lemma cosine_sum : forall a b s, s = a + b -> cos s - cos a * cos b + sin a * sin b = 0.
Proof. intros a b s ->. rewrite cos_plus. ring. Qed.
Lemma exp_sum : forall a b s, s = a + b -> exp s - exp a * exp b = 0.
Proof. intros a b s ->. rewrite exp_plus. ring. Qed.
Lemma log_product : forall a b p, 0 < a -> 0 < b -> p = a * b -> ln p - ln a - ln b = 0.
Proof. intros a b p A B ->. rewrite ln_mult by assumption. ring. Qed.

Lemma arctan_between : forall x, 0 <= x -> x / (1 + x * x) <= atan x <= x.
Proof.
  intros x [P|<-]; [|rewrite atan_0; lra].
  destruct (MVT_cor2 atan (fun c => / (1 + c ^ 2)) 0 x P) as [c [E C]]; [intros; apply derivable_pt_lim_atan|].
  rewrite atan_0 in E. replace (c ^ 2) with (c * c) in E by ring. assert (S : 0 < c * c) by (apply Rmult_lt_0_compat; lra).
  replace (atan x) with (x / (1 + c * c)) by lra. unfold Rdiv. split.
  - apply Rmult_le_compat_l; [lra|]. apply Rinv_le_contravar; [lra|].
    apply Rplus_le_compat_l, Rmult_le_compat; lra.
  - rewrite <- (Rmult_1_r x) at 2. apply Rmult_le_compat_l; [lra|]. rewrite <- Rinv_1 at 2.
    apply Rinv_le_contravar; lra.
Qed.

Lemma arctan_cosine : forall x, 0 < cos (atan x).
Proof. intros x. pose proof (atan_bound x). apply cos_gt_0; lra. Qed.

Lemma arctan_sine : forall x, sin (atan x) - x * cos (atan x) = 0.
Proof.
  intros x. pose proof (tan_atan x) as T. unfold tan in T. pose proof (arctan_cosine x) as C.
  rewrite <- T at 2. field. lra.
Qed.

Lemma arctan_limit : forall x, 0 < 2 * atan 1 - atan x.
Proof. intros x. rewrite atan_1. pose proof (atan_bound x). lra. Qed.

Lemma arctan_tangent : forall x, 0 <= x -> 0 <= x - atan x.
Proof. intros x P. pose proof (arctan_between x P). lra. Qed.

Lemma arctan_sector : forall x, 0 <= atan x * (x - atan x).
Proof.
  assert (H : forall x, 0 <= x -> 0 <= atan x * (x - atan x)).
  { intros x P. pose proof (arctan_between x P) as [L U]. apply Rmult_le_pos; [|lra].
    apply (Rle_trans _ (x / (1 + x * x))); [|exact L]. apply Rmult_le_pos; [exact P|].
    apply Rlt_le, Rinv_0_lt_compat. pose proof (Rle_0_sqr x) as S. unfold Rsqr in S. lra. }
  intros x. destruct (Rle_or_lt 0 x) as [P|N]; [exact (H x P)|].
  pose proof (H (- x)) as T. rewrite atan_opp in T. lra.
Qed.

Lemma arctan_slope : forall x, 0 <= x * (atan x * (1 + x * x) - x).
Proof.
  assert (H : forall x, 0 <= x -> 0 <= x * (atan x * (1 + x * x) - x)).
  { intros x P. apply Rmult_le_pos; [exact P|]. pose proof (arctan_between x P) as [L _].
    pose proof (Rle_0_sqr x) as S. unfold Rsqr in S.
    apply (Rmult_le_compat_r (1 + x * x)) in L; [|lra]. unfold Rdiv in L. rewrite Rmult_assoc, Rinv_l in L; lra. }
  intros x. destruct (Rle_or_lt 0 x) as [P|N]; [exact (H x P)|].
  pose proof (H (- x)) as T. rewrite atan_opp in T. lra.
Qed.

Lemma arctan_zero : forall a, a = 0 -> atan a = 0. Proof. intros a ->. apply atan_0. Qed.
Lemma arctan_turned : forall x y, x = - y -> atan x = - atan y. Proof. intros x y ->. apply atan_opp. Qed.
Lemma sin_zero : forall a, a = 0 -> sin a = 0. Proof. intros a ->. apply sin_0. Qed.
Lemma cos_zero : forall a, a = 0 -> cos a = 1. Proof. intros a ->. apply cos_0. Qed.
Lemma sin_turned : forall x y, x = - y -> sin x = - sin y. Proof. intros x y ->. apply sin_neg. Qed.
Lemma cos_turned : forall x y, x = - y -> cos x = cos y. Proof. intros x y ->. apply cos_neg. Qed.

Lemma exp_minus_inv : forall x y, x = - y -> exp x = / exp y.
Proof. intros x y ->. apply exp_Ropp. Qed.

Lemma ln_reciprocal : forall a k, 0 < a -> k * a = 1 -> ln a = - ln k.
Proof.
  intros a k P E. assert (K : k = / a) by (field_simplify_eq; lra).
  rewrite K, ln_Rinv by exact P. ring.
Qed.

Lemma ln_one : forall a, a = 1 -> ln a = 0. Proof. intros a ->. apply ln_1. Qed.
Lemma exp_zero : forall a, a = 0 -> exp a = 1. Proof. intros a ->. apply exp_0. Qed.
Lemma exp_shift : forall a b c, a = b + c -> exp a = exp b * exp c. Proof. intros a b c ->. apply exp_plus. Qed.

Lemma exp_log_power : forall a (n : nat), 0 < a -> exp (INR n * ln a) = a ^ n.
Proof.
  intros a n P. induction n as [|n IH]; [simpl; rewrite Rmult_0_l; apply exp_0|].
  rewrite S_INR, Rmult_plus_distr_r, exp_plus, IH, Rmult_1_l, exp_ln by exact P. simpl. ring.
Qed.

Lemma exp_log_inverse_power : forall a (n : nat), 0 < a -> exp (- (INR n * ln a)) = / a ^ n.
Proof. intros. rewrite exp_Ropp, exp_log_power by assumption. reflexivity. Qed.

Lemma tanh_exp : forall x, tanh x = (exp (2 * x) - 1) / (exp (2 * x) + 1).
Proof.
  intros x. unfold tanh, sinh, cosh. pose proof (exp_pos x) as P. rewrite exp_Ropp.
  replace (2 * x) with (x + x) by ring. rewrite exp_plus. field.
  assert (0 < exp x * exp x) by (apply Rmult_lt_0_compat; exact P). lra.
Qed.

Lemma abs_of : forall x y, x = y -> Rabs x = Rabs y. Proof. intros; subst; reflexivity. Qed.
Lemma abs_turned : forall x y, x = - y -> Rabs x = Rabs y. Proof. intros x y ->. apply Rabs_Ropp. Qed.
Lemma sgn_pos : forall x, 0 < x -> sgn x = 1.
Proof. intros x P. unfold sgn. destruct (total_order_T x 0) as [[|]|]; lra. Qed.
Lemma sgn_neg : forall x, x < 0 -> sgn x = -1.
Proof. intros x P. unfold sgn. destruct (total_order_T x 0) as [[|]|]; lra. Qed.
Lemma sgn_zero : forall x, x = 0 -> sgn x = 0.
Proof. intros x P. unfold sgn. destruct (total_order_T x 0) as [[|]|]; lra. Qed.
Lemma sgn_turned : forall x y, x = - y -> sgn x = - sgn y.
Proof. intros x y ->. unfold sgn. destruct (total_order_T (- y) 0) as [[|]|], (total_order_T y 0) as [[|]|]; lra. Qed.

Lemma max_abs : forall a b, Rmax a b = (a + b + Rabs (a - b)) / 2.
Proof. intros. unfold Rmax, Rabs. destruct (Rle_dec a b), (Rcase_abs (a - b)); lra. Qed.
Lemma min_abs : forall a b, Rmin a b = (a + b - Rabs (a - b)) / 2.
Proof. intros. unfold Rmin, Rabs. destruct (Rle_dec a b), (Rcase_abs (a - b)); lra. Qed.

Lemma abs_square : forall x, Rabs x * Rabs x - x * x = 0.
Proof. intros. unfold Rabs. destruct (Rcase_abs x); ring. Qed.
Lemma sqrt_squared : forall x, 0 <= x -> sqrt x * sqrt x - x = 0.
Proof. intros. rewrite sqrt_sqrt by assumption. ring. Qed.
Lemma sqrt_number : forall x y, 0 <= y -> x = y * y -> sqrt x = y.
Proof. intros x y P ->. apply sqrt_square. exact P. Qed.

Lemma not_zero : forall x, x <> 0 -> x = 0 -> False. Proof. intros x N Z. exact (N Z). Qed.

(* --- rule cases --- *)

Lemma two_cases : forall x, x >= 0 \/ - x >= 0. Proof. intros x. destruct (Rle_or_lt 0 x); [left|right]; lra. Qed.
Lemma three_cases : forall x, - x > 0 \/ x > 0 \/ x = 0.
Proof. intros x. destruct (total_order_T x 0) as [[|]|]; lra. Qed.
Lemma abs_plus : forall x y, x >= 0 -> y = x -> Rabs y = x. Proof. intros. subst. apply Rabs_right. assumption. Qed.
Lemma abs_minus : forall x y, x >= 0 -> y = - x -> Rabs y = x.
Proof. intros. subst. rewrite Rabs_Ropp. apply Rabs_right. assumption. Qed.

(* --- tactics: nothing is trusted in them, the kernel sees what they make --- *)

(* linear arithmetic of the goal alone: what stands in the context would all be read *)
Ltac linear := clear; lra.

(* an expression is not zero because a known one, which equals it up to ring laws, is not *)
Ltac nonzero_plainly :=
  first [ assumption
        | match goal with
          | P : ?p > 0 |- ?p <> 0 => exact (pos_ne p P)
          | P : 0 < ?p |- ?p <> 0 => exact (pos_ne p P)
          end
        | match goal with |- IZR _ <> 0 => linear end
        | match goal with |- ?a * ?b <> 0 => apply product_ne; nonzero_plainly end
        | match goal with |- ?a ^ _ <> 0 => apply power_ne; nonzero_plainly end
        | match goal with |- / ?a <> 0 => apply Rinv_neq_0_compat; nonzero_plainly end ].

Ltac nonzero :=
  repeat match goal with |- _ /\ _ => split end;
  solve [ nonzero_plainly
        | linear
        | match goal with
          | N : ?p <> 0 |- ?q <> 0 => replace q with p by ring; exact N
          | N : ?p <> 0 |- ?q <> 0 => replace q with (- p) by ring; apply Ropp_neq_0_compat; exact N
          end
        | lra
        | match goal with |- ?a * ?b <> 0 => apply product_ne; nonzero end
        | match goal with |- ?a ^ _ <> 0 => apply power_ne; nonzero end
        | match goal with |- / ?a <> 0 => apply Rinv_neq_0_compat; nonzero end ].

Ltac same := try reflexivity; solve [ ring | field; nonzero ].
