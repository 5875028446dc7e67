"use strict";(()=>{function se(n){return n==="inf"?1/0:n==="-inf"?-1/0:typeof n=="number"?n:NaN}var ia=new DataView(new ArrayBuffer(8));function ed(n){let t=Math.abs(n);return ia.setFloat64(0,t),ia.setBigInt64(0,ia.getBigInt64(0)+1n),ia.getFloat64(0)-t}function Ns(n,t){let e=n*t,i=134217729*n,s=i-(i-n),r=n-s;i=134217729*t;let o=i-(i-t),a=t-o;return[e,r*a-(e-s*o-r*o-s*a)]}function nd(n){let t=[];for(let r of n){let o=0;for(let a of t){Math.abs(r)<Math.abs(a)&&([r,a]=[a,r]);let c=r+a,l=a-(c-r);l!==0&&(t[o++]=l),r=c}t.length=o,t.push(r)}let e=t.length-1,i=t[e]??0,s=0;for(;e>0&&s===0;){let r=i,o=t[--e];i=r+o,s=o-(i-r)}if(e>0&&Math.sign(s)===Math.sign(t[e-1])&&s!==0){let r=s*2,o=i+r;r===o-i&&(i=o)}return i}function kr(n,t){let[e,i]=Ns(n,n),[s,r]=Ns(t,t),o=Math.max(e,s)+Math.min(e,s),a=Math.min(e,s)-(o-Math.max(e,s))+i+r,c=Math.sqrt(o);if(!(c>0))return c;let[l,h]=Ns(c,c);return c+(o-l-h+a)/(2*c)}var[i_,s_]=[.017453292519943295,29486522708701687e-35],[r_,o_,a_]=[-.16666666666666632,.00833333333332249,-.0001984126982985795],[l_,c_,h_]=[27557313707070068e-22,-25050760253406863e-24,158969099521155e-24],[u_,f_,d_]=[.0416666666666666,-.001388888888887411,2480158728947673e-20],[p_,m_,g_]=[-27557314351390663e-23,2087572321298175e-24,-11359647557788195e-27];function ns(n){let t=n%360,e=Math.floor(t/90+.5),i=t-90*e,[s,r]=Ns(i,i_),o=r+i*s_,a=s*s,c=a*a,l=a*s,h=o_+a*(a_+a*l_)+a*c*(c_+a*h_),u=s-(a*(.5*o-l*h)-o-l*r_);h=a*(u_+a*(f_+a*d_))+c*c*(p_+a*(m_+a*g_));let f=.5*a;c=1-f;let d=c+(1-c-f+(a*h-s*o));return[[d,u],[0-u,d],[0-d,0-u],[u,0-d]][(e%4+4)%4]}var si=[0,0,1],id=8,__=4e-15,x_=.01,y_=4096,pe=(n,t)=>n[0]*t[0]+n[1]*t[1]+n[2]*t[2],Ri=(n,t)=>[n[1]*t[2]-n[2]*t[1],n[2]*t[0]-n[0]*t[2],n[0]*t[1]-n[1]*t[0]],ri=(n,t)=>[n[0]-t[0],n[1]-t[1],n[2]-t[2]];function oh(n,t){let e=pe(n,t);return[n[0]-e*t[0],n[1]-e*t[1],n[2]-e*t[2]]}function sd(n){let t=Math.max(Math.abs(n[0]),Math.abs(n[1]),Math.abs(n[2])),[e,i,s]=[n[0]/t,n[1]/t,n[2]/t],r=Math.sqrt(e*e+i*i+s*s);return[e/r,i/r,s/r]}var rh=n=>nd([-1,...n.flatMap(t=>Ns(t,t))]),sa=new Map;function ze(n){let t=`${n[0]} ${n[1]} ${n[2]} ${Object.is(n[0],-0)}${Object.is(n[1],-0)}${Object.is(n[2],-0)}`,e=sa.get(t);return e===void 0&&(sa.size>=y_&&sa.clear(),e=v_(n),sa.set(t,e)),e}function v_(n){let t=sd(n),e=t,i=Math.abs(rh(t));if(i===0)return t;let s=-1;for(let r=0;r<3;r++)Math.abs(t[r])>x_&&(s<0||Math.abs(t[r])<Math.abs(t[s]))&&(s=r);for(let r=0;r<3;r++){if(r===s||t[r]===0)continue;let o=ed(t[r]);for(let a=-id;a<=id;a++){let c=[...t];c[r]+=a*o,c[s]-=rh(c)/(2*t[s]);let l=Math.abs(rh(c));Math.abs(c[s]-t[s])<=__&&l<i&&(e=c,i=l)}}return e}function Pi(n){let t=sd(oh(Math.abs(n[0])>.999999999?[0,1,0]:[1,0,0],n));return[t,Ri(n,t)]}var nn=n=>Math.abs(n[0])+Math.abs(n[1])+Math.abs(n[2]);function zr(n,{v:t,w:e},i){let[s,r]=[pe(t,i),Ri(e,i)];return[t[0]-s*i[0]-n*r[0],t[1]-s*i[1]-n*r[1],t[2]-s*i[2]-n*r[2]]}var Ds=(n,t,e)=>Math.max(...zr(n.radius,t,e).map(Math.abs))>1e-9*(nn(t.v)+n.radius*nn(t.w)),ra=(n,t)=>Ds(n,t,si),is=(n,{v:t,w:e})=>n.mass*pe(t,t)/2+n.kappa*n.mass*n.radius**2*pe(e,e)/2;var b_=1e-12,oi=(n,t)=>[n[t],n[t+1],n[t+2]];function M_(n,t,e){let i=n.memory.take(48),s={stiffness_ratio:t.stiffness,floor_friction:t.floor?.mu??0,tangential_restitution:t.beta}[e.last];n.exports[e.function](...t.v,...t.w,...t.n,t.radius,t.kappa,t.e,t.mu,s,i);let r=n.memory.numbers(i,6);return{v:oi(r,0),w:oi(r,3)}}function S_(n,t,e){if(t.floor===null)return null;let{memory:i,layout:s}=n,r=[...e.v,...e.w,...t.n,t.radius,t.kappa,t.floor.e,t.floor.mu,t.floor.beta,t.g,t.height],[o,a]=[i.put(r),i.take(168)];n.call("second_impact",0,o,r.length,a,21);let c=i.numbers(a,21);return{duration:c[0],height:c[1],distance:c[2],after:{v:oi(c,3),w:oi(c,6)},required:c[12],regime:s.regimes[c[13]],rolling:{v:oi(c,14),w:oi(c,17)},why:c[20]}}function od(n,t){let e=ri(t.v,n.v),i=[e[0]*n.mass,e[1]*n.mass,e[2]*n.mass],s=pe(i,n.n),r=[i[0]-s*n.n[0],i[1]-s*n.n[1],i[2]-s*n.n[2]];return s>0?Math.sqrt(pe(r,r))/s:0}function ah(n,t,e){let i=S_(n,t,e);return{afterWall:e,final:i===null?e:i.rolling,required:od(t,e),requiredFloor:i===null?0:i.required,why:i===null?"":n.layout.reasons[i.why],steps:i,impact:null}}function rd(n,t,e){let{memory:i,layout:s}=n,r=t.floor??{e:0,mu:0,beta:0},o=t.floor===null?1:t.height,a=[...t.v,...t.w,...t.n,t.radius,t.kappa,t.e,t.mu,t.beta,r.e,r.mu,r.beta,o,Number(e)],[c,l]=[i.put(a),i.take(112)];n.call("first_impact",0,c,a.length,l,14);let h=i.numbers(l,14),[u,f,d]=oi(h,9),g=[u*t.mass,f*t.mass,d*t.mass],_=g[2]>0?Math.hypot(g[0],g[1])/g[2]:0,p=ah(n,t,{v:oi(h,0),w:oi(h,3)}),m=Number.isNaN(p.requiredFloor)?0:p.requiredFloor;return{...p,required:h[12],requiredFloor:Math.max(m,_>=s.limits.least_firm/2?1/0:_),impact:{regime:s.regimes[h[13]],required:h[12],floorImpulse:g}}}function w_(n,t,e){let i=n.layout.laws.find(({name:g})=>g===e.on_table),s=t.v[2]===0?0:t.radius,r=t.floor&&{e:0,mu:t.floor.mu,beta:0},[o,a]=[t.given.e?t.e:e.defaults.restitution??t.e,t.given.mu?t.mu:e.defaults.friction??t.mu],c=lh(n,{...t,e:o,mu:a,beta:0,floor:r,height:s,together:!0},i),[l,h,u]=c.afterWall.v,f=ah(n,t,{v:[l,h,t.v[2]===0&&t.n[2]<=b_?0:u],w:c.afterWall.w}),d=c.impact&&(u>0?0:c.requiredFloor);return{...f,required:c.required,requiredFloor:d??f.requiredFloor,vertical:u}}function lh(n,t,e){let{responses:i}=n.layout;if(e.on_table!=="")return w_(n,t,e);if(e.response===i["two-step"])return rd(n,t,t.together);if(e.name==="two-step-after")return rd(n,t,!1);let s=M_(n,t,e),r={afterWall:s,final:s,why:"",steps:null,impact:null};if(e.response===i.mirror)return{...r,required:0,requiredFloor:0};if(e.response===i.rolling){let o=Ds(t,{v:t.v,w:t.w},t.n)?1:0;return{...r,required:o,requiredFloor:o}}return e.ignores_floor?{...r,required:od(t,s),requiredFloor:0}:ah(n,t,s)}var Ce={face:0,over:1,line:2,point:3,rim:4},sn=(n,t,e)=>({kind:n,p:t,d:si,R:0,side:1,u:[1,0,0],lo1:-1/0,hi1:1/0,lo2:-1/0,hi2:1/0,...e}),ss=(n,t)=>sn(Ce.face,n,{d:t,u:Pi(t)[0]}),rs=(n,t,e=-1/0,i=1/0,s=0,r=1)=>sn(Ce.line,n,{d:t,R:s,side:r,u:Pi(t)[0],lo1:-1,hi1:1,lo2:e,hi2:i}),ch=(n,t,e)=>rs([n[0],n[1],0],si,t,e),aa=n=>sn(Ce.point,n),hh=(n,t,e)=>sn(Ce.face,n,{d:t,R:e,u:Pi(t)[0]}),la=(n,t,e,i,s=-1)=>sn(Ce.rim,n,{d:t,R:e,u:i??Pi(t)[0],lo1:s});function oa(n,t,e,i,s){let[r,o]=ze([e[0]-t[0],e[1]-t[1],0]),a=kr(t[0]-e[0],t[1]-e[1]);return sn(n,[t[0],t[1],0],{d:[o,-r,0],u:[r,o,0],lo1:0,hi1:a,lo2:i,hi2:s})}function ca(n,t){let e=[n,t].filter(Number.isFinite).sort((i,s)=>i-s);return e.length===2&&e[0]===e[1]?[e[0]]:e}function ha(n,t,e,i,s=!1){let o=(t?[...n.slice(1),n[0]]:n.slice(1)).map((l,h)=>[n[h],l]),a=ca(e,i),c=[];for(let[l,h]of o){e<i&&(c.push(oa(Ce.face,h,l,e,i)),s||c.push(oa(Ce.face,l,h,e,i)));let u=ze([h[0]-l[0],h[1]-l[1],0]),f=kr(l[0]-h[0],l[1]-h[1]);for(let d of a)c.push(rs([l[0],l[1],d],u,0,f))}if(!s)for(let l of n){e<i&&c.push(ch(l,e,i));for(let h of a)c.push(aa([l[0],l[1],h]))}if(Number.isFinite(i))for(let[l,h]of o)c.push(oa(Ce.over,h,l,i,1/0)),t||c.push(oa(Ce.over,l,h,i,1/0));return c}var ua=1e-12;function ad(n,t){let{point:e,width:i}=n;return[e[0]+i*t[0],e[1]+i*t[1],e[2]+i*t[2]]}function ld(n,t){let[e,i]=Pi(ze(n.axis)),[s,r]=ns(t);return[s*e[0]+r*i[0],s*e[1]+r*i[1],s*e[2]+r*i[2]]}function fa(n){let t=n.size,e=n.center,i=n.corner??[e[0]-t[0]/2,e[1]-t[1]/2,e[2]-t[2]/2];return[i,[i[0]+t[0],i[1]+t[1],i[2]+t[2]]]}var Vr=[[1,0,0],[0,1,0],[0,0,1]];function E_(n){let t=fa(n),e=[];for(let i=0;i<3;i++)for(let s of[0,1]){let[r,o]=[(i+1)%3,(i+2)%3],a=s===1!==n.inside?1:-1,c=[a*Vr[i][0],a*Vr[i][1],a*Vr[i][2]];if(n.inside){e.push(ss(t[s],c));continue}let l=[...t[0]];l[i]=t[s][i];let[h,u]=a>0?[0,n.size[o]]:[-n.size[o],0];e.push(sn(Ce.face,l,{d:c,u:Vr[r],lo1:0,hi1:n.size[r],lo2:h,hi2:u}))}if(n.inside)return e;for(let i=0;i<3;i++){let[s,r]=[(i+1)%3,(i+2)%3];for(let o of[0,1])for(let a of[0,1]){let c=[...t[0]];c[s]=t[o][s],c[r]=t[a][r],e.push(rs(c,Vr[i],0,n.size[i]))}}for(let i of[0,1])for(let s of[0,1])for(let r of[0,1])e.push(aa([t[i][0],t[s][1],t[r][2]]));return e}function A_(n){let[[t,e],i,s]=[n.center,n.length/2,n.width/2];return[[t-i,e-s],[t+i,e-s],[t+i,e+s],[t-i,e+s]]}function T_(n){let t=n.points;if(!n.closed)return t;let e=0;return t.forEach(([i,s],r)=>{let[o,a]=t[(r+1)%t.length];e+=i*a-s*o}),e<0?[...t].reverse():t}function fh(n){let[t,e,i]=[n.point,ze(n.axis),se(n.length)];return[t[0]+i*e[0],t[1]+i*e[1],t[2]+i*e[2]]}function C_(n){let[t,e,i,s]=[n.point,ze(n.axis),n.radius,se(n.length)];if(!(s<1/0))return[rs(t,e,-1/0,1/0,i,n.inside?-1:1)];let r=(n.inside?[-1,1]:[1]).map(o=>rs(t,e,0,s,i,o));return n.inside||r.push(hh(t,[-e[0],-e[1],-e[2]],i),hh(fh(n),e,i)),[...r,la(t,e,i),la(fh(n),e,i)]}function R_(n,t){let[e,i]=[ri(t,n.point),ze(n.axis)],s=oh(e,i),r=Math.sqrt(pe(s,s));if(se(n.length)<1/0){let o=pe(e,i);return!n.inside&&r<n.radius&&0<o&&o<se(n.length)}return n.inside?r>n.radius:r<n.radius}var da=n=>n.to_angle-n.from_angle>=360;function P_(n){let[t,e,i]=[se(n.low),se(n.height),n.to_angle-n.from_angle],s=[...ns(n.from_angle+i/2),0],r=da(n)?-1:ns(i/2)[0],[o,a]=n.center,c=n.radius,l=(u,f,d,g)=>sn(u,[o,a,0],{R:c,side:f,u:s,lo1:r,hi1:1,lo2:d,hi2:g}),h=t<e?[-1,1].map(u=>l(Ce.line,u,t,e)):[];for(let u of ca(t,e))h.push(la([o,a,u],si,c,s,r));if(!da(n))for(let u of[n.from_angle,n.to_angle]){let[f,d]=ns(u),g=[o+c*f,a+c*d];t<e&&h.push(ch(g,t,e));for(let _ of ca(t,e))h.push(aa([...g,_]))}if(Number.isFinite(e))for(let u of da(n)?[-1]:[-1,1])h.push(l(Ce.over,u,e,1/0));return h}function I_(n){let[t,e,i]=[ns(n.angle),n.length/2,n.radius],s=[-t[1],t[0]],r=(a,c)=>[n.center[0]+a*t[0]+c*s[0],n.center[1]+a*t[1]+c*s[1],0],o=[];for(let a of[1,-1]){let c=[a*t[0],a*t[1],0];o.push(sn(Ce.face,r(0,-a*i),{d:[-c[1],c[0],0],u:c,lo1:-e,hi1:e})),o.push(sn(Ce.line,r(a*e,0),{R:i,side:-1,u:c,lo1:0,hi1:1}))}return o}var uh=(n,t)=>se(n.low)<=t&&t<=se(n.height),cd=n=>Math.abs(ze(n)[2])<ua,Us={plane:{features:n=>[ss(n.point,ze(n.normal))],blocked:(n,t)=>pe(ri(t,n.point),n.normal)<0,vertical:n=>cd(n.normal)},strip:{features:n=>{let t=ze(n.normal);return[ss(n.point,t),ss(ad(n,t),[-t[0],-t[1],-t[2]])]},blocked:(n,t)=>{let e=ze(n.normal);return pe(ri(t,n.point),e)<0||pe(ri(t,ad(n,e)),e)>0},vertical:n=>cd(n.normal)},wedge:{features:n=>{let t=ze(n.axis),[e,i]=[ld(n,n.from_angle),ld(n,n.to_angle)];return n.to_angle-n.from_angle<=180?[ss(n.apex,Ri(t,e)),ss(n.apex,Ri(i,t))]:[sn(Ce.face,n.apex,{d:Ri(t,e),u:e,lo1:0}),sn(Ce.face,n.apex,{d:Ri(i,t),u:i,lo1:0}),rs(n.apex,t)]},blocked:(n,t)=>{let e=ri(t,n.apex),[i,s]=Pi(ze(n.axis)),r=Math.atan2(pe(e,s),pe(e,i))*180/Math.PI-n.from_angle;return r-360*Math.floor(r/360)>n.to_angle-n.from_angle},vertical:n=>Math.abs(ze(n.axis)[2])>1-ua},box:{features:E_,blocked:(n,t)=>{let[e,i]=fa(n);return[0,1,2].every(s=>e[s]<t[s]&&t[s]<i[s])!==n.inside},vertical:(n,t)=>fa(n)[0][2]<=t&&t<=fa(n)[1][2]},segment:{features:n=>ha([n.start,n.end],!1,se(n.low),se(n.height)),blocked:()=>!1,vertical:uh},polygon:{features:n=>ha(T_(n),n.closed,se(n.low),se(n.height)),blocked:()=>!1,vertical:uh,encloses:n=>n.closed},table:{features:n=>ha(A_(n),!0,n.nose_height??-1/0,se(n.height),!0),blocked:(n,t)=>Math.abs(t[0]-n.center[0])>n.length/2||Math.abs(t[1]-n.center[1])>n.width/2,vertical:(n,t)=>(n.nose_height===null||n.nose_height<=t)&&t<=se(n.height),encloses:()=>!0,room:n=>Math.min(n.length,n.width)/2},cylinder:{features:C_,blocked:R_,vertical:(n,t)=>{let e=se(n.length)<1/0?[n.point[2],fh(n)[2]]:[-1/0,1/0];return Math.abs(ze(n.axis)[2])>1-ua&&Math.min(...e)<=t&&t<=Math.max(...e)},room:n=>n.inside&&!(se(n.length)<1/0)?n.radius:1/0},sphere:{features:n=>[sn(Ce.point,n.center,{R:n.radius,side:n.inside?-1:1})],blocked:(n,t)=>{let e=ri(t,n.center),i=Math.sqrt(pe(e,e));return n.inside?i>n.radius:i<n.radius},vertical:(n,t)=>Math.abs(t-n.center[2])<ua*n.radius,room:n=>n.inside?n.radius:1/0},arc:{features:P_,blocked:()=>!1,vertical:uh,encloses:da},stadium:{features:I_,blocked:(n,t)=>{let[[e,i],s,r]=[ns(n.angle),t[0]-n.center[0],t[1]-n.center[1]],[o,a]=[s*e+r*i,r*e-s*i];return kr(Math.max(Math.abs(o)-n.length/2,0),a)>n.radius},vertical:()=>!0,room:n=>n.radius}};var L_={solid:2/5,hollow:2/3},Gr=n=>typeof n.inertia=="string"?L_[n.inertia]:n.inertia;function N_(n){let[t,e]=n.velocity;return n.rolling?[-e/n.radius,t/n.radius,n.spin_z??0]:n.spin??[0,0,0]}function dh(n,t,e){let i=t.law??n.run.law,s=e.laws.find(r=>r.name===i);if(s===void 0)throw new Error(`law: expected one of ${e.laws.map(r=>r.name).join(", ")}, got ${i}`);return s}function D_(n,t){let e=n??{form:"constant",value:1},i=t.forms[e.form==="han-2005"?"polynomial":e.form];switch(e.form){case"constant":return[i,[e.value,0,0]];case"polynomial":return[i,e.coefficients];case"han-2005":return[i,t.han2005];case"power":return[i,[e.at_rest,e.speed,e.exponent]];case"viscoelastic":return[i,[e.c,0,0]];case"exponential":return[i,[e.at_rest,e.at_speed,e.speed]];default:throw new Error(`restitution: expected one of ${Object.keys(t.forms).join(", ")}, got ${e.form}`)}}function os(n,t){let[e,i]=D_(n.restitution,t);return{form:e,p:i,mu:n.friction===null?1/0:se(n.friction),beta:n.tangential_restitution}}var hd=(n,t)=>Object.fromEntries(Object.entries(t).map(([e,i])=>[`${n}_${e}`,i]));function U_(n,{defaults:t}){let e=n.restitution??(t.restitution===void 0?null:{form:"constant",value:t.restitution});return{...n,restitution:e,friction:n.friction??t.friction??null}}function O_(n,t,e,i){let s=os(U_(t,e),i);if(e.response===i.responses.contact){let{restitution:r,friction:o,tangential_restitution:a}=e.pinned;r!==void 0&&([s.form,s.p]=[i.forms.constant,[se(r),0,0]]),o!==void 0&&(s.mu=se(o)),a!==void 0&&(s.beta=se(a))}return e.last==="stiffness_ratio"&&(s.beta=t.stiffness_ratio),e.last==="floor_friction"&&(s.beta=n.floor?os(n.floor,i).mu:0),s}function Ii(n,t,e){let i=n.floor,s={force:n.gravity,...i&&{floor:1,g:-n.gravity[2],...hd("floor",os(i,t))},...i&&{resistance:i.rolling_resistance,spin_friction:i.spin_friction},...hd("pair",os(n.ball_contact,t)),together:n.run.floor_contact==="with"},r=n.walls.map(l=>dh(n,l,t)),o=[...new Set(r.filter(l=>l.response===t.responses.called))],a=n.walls.flatMap((l,h)=>{let u=r[h],{form:f,p:d,mu:g,beta:_}=O_(n,l,u,t),p=u.response+(u.response===t.responses.called?o.indexOf(u):0),m=Us[l.shape],y={wall:h,form:f,e:d,mu:g,beta:_,law:p,ends:m.encloses?.(l)??!1};return m.features(l).map(S=>({...S,...y,at:S.kind===t.features.rim?e:0}))}),c=n.balls.map(l=>({radius:l.radius,mass:l.mass,kappa:Gr(l),x:pa(n,l),v:l.velocity,w:N_(l)}));return{world:s,features:a,balls:c,called:o}}function pa(n,t){let[e,i,s]=t.position;return[e,i,s??(n.floor?t.radius:0)]}function re(n,t){if(!Number.isFinite(n))return Number.isNaN(n)?"nan":n>0?"inf":"-inf";if(n===0)return Object.is(n,-0)?"-0":"0";let[e,i]=n.toExponential(t-1).split("e"),s=Number(i),r=o=>o.includes(".")?o.replace(/\.?0+$/,""):o;return s<-4||s>=t?`${r(e)}e${s<0?"-":"+"}${String(Math.abs(s)).padStart(2,"0")}`:r(n.toFixed(Math.max(t-1-s,0)))}var Os=(n,t)=>`(${Array.from(n,e=>re(e,t)).join(", ")})`;function Gn(n,t=3){if(Number.isNaN(n))return"\u2013";if(!Number.isFinite(n))return n>0?"\u221E":"\u2212\u221E";let e=Math.abs(n);if(n!==0&&!(e>=.001&&e<1e4))return re(n,t);let i=n===0?t:Math.max(0,t-1-Math.floor(Math.log10(e))),s=n.toFixed(i);return s.includes(".")?s.replace(/\.?0+$/,""):s}function Hn(n,t=3){let e=Math.abs(n);return e>=1?`${Gn(n,t)} m`:e>=.001?`${Gn(n*1e3,t)} mm`:`${Gn(n*1e6,t)} \xB5m`}var ud=n=>n>=1?`${Gn(n)} s`:`${Gn(n*1e3)} ms`;var F_=2e3,B_=2e3,k_=256,z_=128,V_=4096;function ph(n,t,e){let{memory:i,layout:s}=n,{records:r,run:o}=s;i.clear();let a=Ii(t,s,n.address("rim")),c=a.balls.length,l=i.records(r.world,[a.world]),h=i.records(r.features,a.features),u=i.records(r.balls,a.balls),f=i.take(8*Math.max(a.called.length,1));a.called.forEach((L,I)=>i.putWhole(f+8*I,n.address(L.function)));let d=i.take(64),g=e.until??t.run.duration??1/0,_=Math.min(e.events??F_,t.run.max_events??1/0),p=performance.now()+(e.milliseconds??B_),m=[],[y,S,v,A,E,x]=[-1,0,o.full,-1,0,z_+c];for(;v===o.full;){let L=i.take(x*r.log.bytes),I=Math.min(_-S,k_);n.call("run",d,l,1,h,a.features.length,u,c,L,x,y,g,I,f,a.called.length,o.all);let B=i.words.subarray(d/4);v=B[0],S+=B[2],A=B[6],[y,E]=i.numbers(d+32,2),m.push({at:L,rows:B[4]}),x=Math.min(4*x,V_),v===o.limit&&S<_&&performance.now()<p&&(v=o.full)}let U={[o.done]:"done",[o.quiet]:"quiet",[o.limit]:S<_?"time":"limit"}[v]??"refused",C=U==="done"&&g===1/0?"quiet":U;return{world:l,features:h,balls:u,logs:m,status:C,code:v,end:C==="done"?g:E,atFault:A}}function fd(n,t,e){let i=ph(n,t,e),{status:s,code:r,balls:o,atFault:a}=i;return{...mh(n,t,i),why:s==="refused"?q_(n,t,r,o,a):""}}function mh(n,t,{world:e,balls:i,logs:s,status:r,end:o}){let a=G_(n,s),c=t.balls.map(()=>[]);for(let u of a)c[u.ball].push(u);let l=n.layout.records.balls.bytes,h=r==="quiet"?1/0:o;return{status:r,why:"",until:o,events:a.slice(c.length),final:$_(n,e,i,c,o),balls:c.map((u,f)=>({pieces:H_(n,e,i+f*l,u,h)}))}}function G_(n,t){let{layout:e,memory:i}=n,{kinds:s,phases:r,regimes:o,records:a}=e,l=Object.fromEntries(["t","kind","ball","met","other","x","v_before","w_before","v","w","phase_before","phase","impulse","floor_impulse","required","regime"].map(u=>[u,i.field(a.log,u)])),h=[];for(let u of t)for(let f=0;f<u.rows;f++){let d=u.at+f*a.log.bytes,g=r[l.phase(d)],_=s[l.kind(d)],p=s[l.met(d)],m=l.regime(d);h.push({t:l.t(d),kind:_==="phase"?g:_,ball:l.ball(d),met:p==="nothing"?null:p,other:l.other(d),x:l.x(d),v_before:l.v_before(d),w_before:l.w_before(d),v:l.v(d),w:l.w(d),phase_before:r[l.phase_before(d)],phase:g,impulse:l.impulse(d),floor_impulse:l.floor_impulse(d),required:l.required(d),regime:m<0?null:o[m]})}return h}function dd(n,t,e){let{memory:i,layout:s}=n,r=s.records.balls,o=i.take(r.bytes*Math.max(e.length,1)),a=r.bytes/8,[c,l,h,u]=["x","v","w","clock"].map(p=>r.fields[p].at/8),f=r.fields.phase.at,d=new Map(s.phases.map((p,m)=>[p,m])),g=i.doubles,_=o/8;for(let p of e){g.copyWithin(_,t/8,t/8+a);for(let m=0;m<3;m++)g[_+c+m]=p.x[m],g[_+l+m]=p.v[m],g[_+h+m]=p.w[m];g[_+u]=0,i.putWhole(8*_+f,d.get(p.phase)??0),_+=a}return o}var pd=n=>n==="held"||n==="left";function H_(n,t,e,i,s){let{memory:r,layout:o}=n,a=o.records.balls,c=dd(n,e,i);n.call("begin",0,t,1,c,i.length);let[l,h]=[r.field(a,"acc"),r.field(a,"turn")],u=[];return i.forEach((f,d)=>{let g=i[d+1],_=(g?.t??s)-f.t;if(!(_>0)&&g!==void 0)return;let p=c+d*a.bytes,m={t:f.t,lasts:_,x:f.x,v:f.v,w:f.w,acc:l(p),turn:h(p),phase:f.phase};pd(f.phase)&&Object.assign(m,{v:[0,0,0],acc:[0,0,0],turn:[0,0,0]}),f.phase==="bouncing"&&Object.assign(m,X_(n,t,p,_,f.x)),u.push(...W_(m))}),u}function W_(n){let{t,lasts:e,x:i,v:s,w:r,acc:o,turn:a}=n,c=-r[2]/a[2];if(!(c>0&&c<e))return[n];let l=(d,g,_=[0,0,0])=>[d[0]+g[0]*c+_[0]*c*c/2,d[1]+g[1]*c+_[1]*c*c/2,d[2]+g[2]*c+_[2]*c*c/2],[h,u]=l(r,a),f={...n,t:t+c,lasts:e-c,x:l(i,s,o),v:l(s,o)};return[{...n,lasts:c},{...f,w:[h,u,0],turn:[a[0],a[1],0]}]}function X_(n,t,e,i,s){let{memory:r,layout:o}=n;if(!(i>0))return{v:[0,0,0],acc:[0,0,0]};n.call("states",0,t,1,e,1,r.put([i]),1);let a=r.field(o.records.balls,"x")(e);return{v:[(a[0]-s[0])/i,(a[1]-s[1])/i,0],acc:[0,0,0]}}function $_(n,t,e,i,s){let{memory:r,layout:o}=n,a=o.records.balls;return i.map((c,l)=>{let h=c[c.length-1];if(pd(h.phase))return{x:h.x,v:h.v,w:h.w,phase:h.phase};let u=dd(n,e+l*a.bytes,[h]);n.call("states",0,t,1,u,1,r.put([s-h.t]),1);let[f,d,g]=["x","v","w"].map(_=>r.field(a,_)(u));return{x:f,v:d,w:g,phase:h.phase}})}function q_(n,t,e,i,s){let{memory:r,layout:o}=n,a=i+s*o.records.balls.bytes,[c,l]=["clock","x"].map(u=>r.field(o.records.balls,u)(a));return`${t.balls[s].name??`ball ${s}`}: expected an event that its law has an answer for, got one at t = ${re(c,6)} s, x = ${Os(l,4)}: ${o.refusals[e]}`}function Hr(n,t){let{memory:e,layout:i}=n,{logs:s}=ph(n,t,{events:500}),r=i.records.log,o=s.flatMap(K=>Array.from({length:K.rows},(X,Y)=>K.at+Y*r.bytes)),[a,c,l]=["kind","ball","other"].map(K=>e.field(r,K)),h=o.find(K=>c(K)===0&&i.kinds[a(K)]==="wall"),u=t.balls[0].name??"the first ball";if(h===void 0)throw new Error(`compare: expected a scene in which ${u} meets a wall, got one in which it meets none`);let[f,d,g,_]=["t","x","v_before","w_before"].map(K=>e.field(r,K)(h)),p=l(h),m={...t,run:{...t.run,law:"two-step"},walls:t.walls.map(K=>({...K,law:null}))},y=Ii(m,i,0);e.clear();let S=e.records(i.records.features,y.features),v=e.records(i.records.balls,[{...y.balls[0],x:d,v:g,w:_}]),A=e.take(8*y.features.length);n.call("gaps",0,S,y.features.length,v,1,A,1,y.features.length);let E=-1;e.numbers(A,y.features.length).forEach((K,X)=>{let Y=E<0||Math.abs(K)<Math.abs(e.doubles[A/8+E]);y.features[X].wall===p&&Number.isFinite(K)&&Y&&(E=X)});let x=e.take(40);n.call("meet",0,S+E*i.records.features.bytes,1,v,1,x,5);let[w,U,C,L,I]=e.numbers(x,5),[B,{radius:R,mass:W}]=[t.walls[p],t.balls[0]],{mu:q,beta:H}=os(B,i);return{given:{e:B.restitution!==null,mu:B.friction!==null},t:f,wall:p,radius:R,mass:W,kappa:Number(y.balls[0].kappa),v:g,w:_,n:[w,U,C],e:I,mu:q,beta:H,stiffness:B.stiffness_ratio,floor:t.floor&&Y_(n,t.floor,L),g:t.floor?-t.gravity[2]:0,height:t.floor?Math.max(d[2]-R,0):1/0,together:t.run.floor_contact==="with"}}function Y_(n,t,e){let{form:i,p:s,mu:r,beta:o}=os(t,n.layout),[a,c]=[n.memory.put([i,...s,Math.max(e,0)]),n.memory.take(8)];return n.call("restitution",0,a,5,c,1),{e:n.memory.numbers(c,1)[0],mu:r,beta:o}}var Z_=1e-100;function J_({v:n,w:t,n:e}){let i=pe(n,e)<=1e-12*nn(n)?[]:["a ball that moves towards the wall"],s=Math.max(...[...n,...t].map(Math.abs));return s!==0&&s<Z_&&i.push("a ball at rest, or a component of velocity or spin of at least 1e-100"),i}function K_(n){let t=[];return(!(n.floor!==null&&n.v[2]===0&&n.height===0)||ra(n,n))&&t.push("hypothesis 1: a ball that rolls on the floor without sliding"),Math.abs(n.n[2])<1e-12||t.push("hypothesis 1: a vertical wall (any other lifts the ball or presses it down)"),n.e!==1&&t.push("hypothesis 3: a wall of restitution 1 (with less, energy would have to be created)"),t}function j_(n){if(n.floor===null||!n.together||n.beta===0||n.beta===-1)return[];let t=zr(n.radius,n,n.n),e=n.n[2]<0||t[2]>0&&Math.min(n.mu,1e300)*t[2]>n.n[2]*Math.sqrt(pe(t,t));return n.height===0&&n.v[2]<=0&&(e||n.v[2]<0)?["tangential restitution 0 where the wall presses the ball on the floor"]:[]}function Q_(n,t,e){let[i,s]=e.chi_range??[0,1/0],r=(1+1/n.kappa)/2,o=n.stiffness*r;return i<=o&&o<=s?[]:[`a stiffness ratio from ${re(i/r,3)} to ${re(s/r,3)}, for which the law is tabulated`]}function md(n,{limits:t}){let[e,i]=t.stiffness,s=[];return e<=n.stiffness&&n.stiffness<=i||s.push(`a stiffness ratio from ${re(e,6)} to ${re(i,6)}`),Math.sqrt(n.stiffness*(1+1/n.kappa))<=t.most_omega||s.push(`a stiffness ratio k and an inertia kappa with k (1 + 1/kappa) at most ${re(t.most_omega**2,6)}`),s}var tx={conventional:K_,"two-step":j_,maw:Q_,stronge:md,"stronge-cushion":md},xd=(n,t,e)=>[...J_(n,e,t),...tx[t.name]?.(n,e,t)??[]],gd=n=>n!==null&&n.mu>0&&n.beta>-1;function _h(n,{afterWall:t}){return n.floor!==null&&n.height===0&&t.v[2]<-1e-9*nn(n.v)?["it drives the ball into the floor and ignores the simultaneous reaction of the floor"]:[]}function xh(n,{afterWall:t}){let e=[],[i,s]=[is(n,n),is(n,t)];return s>i*(1+1e-9)&&e.push(`it creates energy: ${re(100*s/i,4)} % is left after the wall`),pe(t.v,n.n)<-1e-9*nn(n.v)&&e.push("it sends the ball through the wall"),e}function ex(n,t){let e=_h(n,t);return gd(n)&&Ds(n,n,n.n)&&e.push("the ball slips on the wall, and this wall has friction: the tangential impulse is ignored"),gd(n.floor)&&ra(n,t.afterWall)&&e.push("the ball leaves the wall sliding on a floor with friction, which bends its path"),e}var nx=(n,t)=>t.requiredFloor>0?["it reverses the slip at the wall, whereas friction can only stop it: the wall would have to pull the ball down and the floor would need a friction above 1, whatever the impulses"]:[];function ix(n,t){let e=n.e!==1?[`it assumes restitution 1; this wall has ${re(n.e,6)}`]:[];return Ds(n,n,n.n)&&(n.beta<1&&e.push(`it assumes tangential restitution 1, which reverses the slip; this wall has ${re(n.beta,6)}`),t.required>n.mu&&e.push(`it requires a wall friction of ${re(t.required,3)}; this wall has ${re(n.mu,6)}`)),[...xh(n,t),...e,..._h(n,t)]}function _d(n,t){let e=[...xh(n,t),..._h(n,t)];return n.beta!==0&&e.push("it models the tangential rebound by springs and ignores this wall's tangential restitution"),e}function sx(n,{afterWall:t}){let e=n.floor!==null&&n.height===0&&n.v[2]===0,i=t.v[2]!==0||ra(n,t);return e&&i?["it ignores the floor on which this ball rests"]:[]}function gh(n,t){let e=xh(n,t);if(n.v[2]!==0||n.height>0)return[...e,"it describes a ball on the table; one in flight meets the cushion as if there were no table"];if(n.n[2]>1e-12)return[...e,"it describes a cushion, which touches the ball at or above its centre"];let i=t.vertical??0;if(!(Math.abs(i)>1e-9*nn(n.v)))return e;let s=100*(n.mass*i*i/2)/is(n,n),r=i>0?"throws it up":"drives it into the table";return[...e,`it keeps the ball on the table, though the cushion ${r}: ${re(s,3)} % of the energy is dropped`]}var rx={mirror:ex,conventional:nx,"no-slip":ix,maw:_d,stronge:_d,contact:sx,han2005:gh,mathavan2010:gh,"stronge-cushion":gh},yd=(n,t,e)=>rx[t.name]?.(n,e)??[];var ox={stick:"sticking",slide:"sliding",graze:"by separation",jam:"jammed",stall:"unresolved"};function vd(n,t,e){let i=[...ax(n,t),...lx(n,t)];return e===null?[...i,`the ball never rolls again: ${t.why}`]:[...i,...cx(n,e)]}function ax(n,{impact:t}){return t===null?[]:t.floorImpulse.some(e=>e!==0)?[`the wall presses the ball on the floor: both act at once, and the wall contact ends ${ox[t.regime]}`]:t.regime==="slide"?[`the ball slides on the wall: its friction ${Gn(n.mu)} is below the ${Gn(t.required)} required for sticking`]:t.regime==="graze"?["the ball only grazes the wall, without an impulse"]:[]}function lx(n,{steps:t}){if(t===null)return[];let e=[];if(Number.isFinite(t.duration)&&t.duration>0){let i=t.after.v[2]>0?", and bounces":"",[s,r]=[Hn(t.distance),Hn(t.height)];if(e.push(`the ball flies for ${ud(t.duration)}, ${s} far and up to ${r} high${i}`),t.regime==="slide"&&t.why===0){let[o,a]=[Gn(n.floor?.mu??0),Gn(t.required)];e.push(`it lands sliding: the floor's friction ${o} is below the ${a} required for sticking`)}}else t.duration===0&&t.why===0&&Math.max(...zr(n.radius,t.after,si).map(Math.abs))>1e-9*nn(t.after.v)&&e.push("the ball stays on the floor and slides until it rolls");return e}function cx(n,t){let[e,i,s]=[n.v,t.v,n.n],r=nn(e)+n.radius*nn(n.w);if(!(Math.abs(i[0])+Math.abs(i[1])>1e-12*r))return["the ball stops at the wall"];let o=[];s[0]*i[0]+s[1]*i[1]<-1e-9*r&&o.push("its spin turns the ball round: it rolls back to the wall and meets it again");let[a,c]=[e,i].map(l=>s[0]*l[1]-s[1]*l[0]);return a*c<0&&Math.abs(c)>1e-12*r?o.push("the ball returns to the side of the normal from which it came"):a===0&&Math.abs(c)>1e-12*r&&o.push(`the ball leaves to the ${c>0?"left":"right"} of the wall's normal`),o}function bd(n,t,e){let i=Math.sqrt(n[0]**2+n[1]**2),[s,r]=[n[0]/i,n[1]/i];return Math.atan2(Math.abs(s*t[1]-r*t[0]),e*(s*t[0]+r*t[1]))*180/Math.PI}function yh(n,t){let e=nn(n.v)+n.radius*nn(n.w);if(!(Math.abs(t.v[0])+Math.abs(t.v[1])>1e-12*e))return null;let i=bd(n.n,t.v,1);return Number.isNaN(i)?null:i}var ma=n=>Number.isNaN(n)?null:n,vh=n=>!n.v.some(Number.isNaN);function Md(n,t,e){let i=xd(t,e,n.layout);if(i.length>0)return{answer:null,why:`no prediction: it requires ${i.join("; and ")}`};let s=lh(n,t,e);return vh(s.afterWall)?{answer:s,why:""}:{answer:null,why:`no prediction: ${s.why}`}}function hx(n,t,e){let{answer:i,why:s}=Md(n,t,e),r={law:e.name,angle:null,angle_after_wall:null,velocity:null,spin:null,after_wall:null,energy_kept:null,hop:null,flight:null,required:null,available:t.mu,required_floor:null,available_floor:t.floor?.mu??null};if(i===null)return{...r,admissible:!1,reasons:[s],remarks:[]};let o=yd(t,e,i),a=vh(i.final)?i.final:null,{afterWall:c,steps:l}=i,h=is(t,t);return{...r,angle:a&&yh(t,a),angle_after_wall:yh(t,c),velocity:a&&a.v,spin:a&&a.w,after_wall:{velocity:c.v,spin:c.w},energy_kept:a&&h>0?is(t,a)/h:null,hop:l&&ma(l.height),flight:l&&ma(l.distance),required:ma(i.required),required_floor:ma(i.requiredFloor),admissible:o.length===0,reasons:o,remarks:vd(t,i,a)}}function ux(n,t){let e=t.height>0,i=!e&&t.n[2]<0;return n.layout.laws.filter(r=>r.variant_of===""&&(e||!r.ignores_floor)&&(i||r.on_table==="")).map(r=>(n.memory.clear(),hx(n,t,r)))}function Sd(n,t){let e=Hr(n,t);return{meeting:e,incidence:bd(e.n,e.v,-1),verdicts:ux(n,e)}}function fx(n,t){let{v:e,w:i,n:s}=n,r=Math.atan2(s[0]*e[1]-s[1]*e[0],-(s[0]*e[0]+s[1]*e[1])),a=-((r<0?-1:1)*t*Math.PI/180-r),[c,l]=[Math.cos(a),Math.sin(a)],h=([u,f,d])=>[c*u-l*f,l*u+c*f,d];return{...n,v:h(e),w:h(i)}}function wd(n,t,e,i,s){return i.map(r=>{n.memory.clear();let o=fx(e,r),{answer:a}=Md(n,o,t),c=a&&(s==="wall"?a.afterWall:a.final);return c&&vh(c)?yh(o,c):null})}var ga=class{constructor(t,e){this.memory=t,this.base=Math.ceil(e/16)*16,this.top=this.base,this.doubles=new Float64Array(t.buffer),this.words=new Int32Array(t.buffer)}clear(){this.top=this.base}take(t){let e=this.top;if(this.top=Math.ceil((e+t)/16)*16,this.top>268435456)throw new Error("engine: expected a run that fits into 256 MB, got a larger one; ask for fewer events");let i=this.top-this.memory.buffer.byteLength;return i>0&&this.memory.grow(Math.ceil(i/65536)),this.doubles.buffer!==this.memory.buffer&&(this.doubles=new Float64Array(this.memory.buffer),this.words=new Int32Array(this.memory.buffer)),new Uint8Array(this.memory.buffer,e,this.top-e).fill(0),e}put(t){let e=this.take(8*Math.max(t.length,1));return this.doubles.set(t,e/8),e}numbers(t,e){return Array.from(this.doubles.subarray(t/8,t/8+e))}putWhole(t,e){this.words[t/4]=e,this.words[t/4+1]=e<0?-1:0}records(t,e){let i=this.take(t.bytes*Math.max(e.length,1));return e.forEach((s,r)=>{for(let[o,a]of Object.entries(s))this.set(t,i+r*t.bytes,o,a)}),i}set(t,e,i,s){let r=t.fields[i];typeof s=="object"?this.doubles.set(s,(e+r.at)/8):r.whole?this.putWhole(e+r.at,Number(s)):this.doubles[(e+r.at)/8]=Number(s)}field(t,e){let{at:i,count:s,whole:r}=t.fields[e];return s===1?c=>r?this.words[(c+i)/4]:this.doubles[(c+i)/8]:c=>{let l=(c+i)/8,h=this.doubles;return[h[l],h[l+1],h[l+2]]}}};var bh=class{constructor(t,e){let i=t.exports;this.exports=i,this.layout=e,this.memory=new ga(i.memory,i.__heap_base.value)}call(t,e,...i){this.exports[t](e,...i)}address(t){return this.exports[`address_of_${t}`]()}};async function _a(n,t){if(typeof WebAssembly>"u")throw new Error("expected a browser with WebAssembly, got one without; any browser of the last years has it");let e=new Uint8Array(n),i=await WebAssembly.compile(e).catch(o=>{throw new Error(`engine.wasm: expected carom's module, got one that the browser refuses: ${o.message}`)}),[s]=WebAssembly.Module.customSections(i,"carom"),r=s===void 0?"none":new TextDecoder().decode(s);if(r!==t.version)throw new Error(`engine.wasm: expected the module of version ${t.version}, got version ${r}; build both anew with make wasm`);return new bh(await WebAssembly.instantiate(i),t)}var dx={quiet:"nothing more happens",done:"duration",limit:"max_events",time:"time of computing",refused:"refused"},px=n=>Number.isFinite(n)?n:null;function Ed(n,t){let e=n.walls.map((r,o)=>r.name||`${r.shape} ${o}`),i=n.balls.map((r,o)=>r.name||`ball ${o}`),s=(r,o,a)=>{let{mass:c,radius:l}=n.balls[r];return c*pe(o,o)/2+Gr(n.balls[r])*c*(l*l)*pe(a,a)/2};return{events:t.events.map(r=>({t:r.t,kind:r.kind,ball:r.ball,position:r.x,velocity:r.v,spin:r.w,other:r.other,name:r.met==="wall"?e[r.other]:r.met==="ball"?i[r.other]:"",phase:r.phase,impulse:r.impulse,required_friction:px(r.required),energy_lost:s(r.ball,r.v_before,r.w_before)-s(r.ball,r.v,r.w)})),final:t.final.map(({x:r,v:o,w:a,phase:c},l)=>({position:r,velocity:o,spin:a,phase:c,name:i[l]})),end:t.until,ended:dx[t.status]}}var[mx,gx]=[1e-100,1e100],Ad=60,_x={kind:"number",what:"an acceleration in m/s^2"},xx="'solid', 'hollow', or kappa = I/(m a^2) in (0, 2/3]";function yx(n){let t=n==null?"nothing":JSON.stringify(n)??String(n);return t.length>Ad?`${t.slice(0,Ad-3)}...`:t}var xa=n=>typeof n=="object"&&n!==null&&!Array.isArray(n);function Td(n,t){let e=se(n),i=t.least??-1/0,s=t.above?e>i:e>=i,r=Math.abs(e),o=(t.above?r>=mx:!0)&&r<=gx;return s&&e<=(t.most??1/0)&&(o||t.infinite===!0&&r===1/0)}var Mh=class{constructor(t){this.layout=t,this.faults=[]}fault(t,e,i){this.faults.push(`${t}: expected ${e}, got ${yx(i)}`)}table(t,e,i){if(!xa(e)){this.fault(t,"a table of fields",e);return}for(let s of Object.keys(e))Object.hasOwn(i,s)||this.fault(t,"a field that is known here",s);for(let[s,r]of Object.entries(i))r.kind!=="part"&&this.field(t===""?s:`${t}.${s}`,e[s],r)}field(t,e,i){if(e==null){i.optional||this.fault(t,i.what??"a value",e);return}let s=["text","law"].includes(i.kind);i.kind==="number"&&!Td(e,i)?this.fault(t,i.what??"a number",e):i.kind==="vector"||i.kind==="gravity"?this.vector(t,e,i):i.kind==="flag"&&typeof e!="boolean"?this.fault(t,"true or false",e):i.kind==="choice"&&!i.values?.includes(String(e))?this.fault(t,`one of ${i.values?.join(", ")}`,e):i.kind==="whole"&&!(Number.isInteger(e)&&Number(e)>=1)?this.fault(t,"a whole number >= 1",e):s&&typeof e!="string"?this.fault(t,"a text",e):i.kind==="law"&&!this.layout.laws.some(r=>r.name===e)?this.fault(t,`one of ${this.layout.laws.map(r=>r.name).join(", ")}`,e):i.kind==="restitution"?this.restitution(t,e):i.kind==="inertia"&&e!=="solid"&&e!=="hollow"&&(Td(e,{kind:"number",least:0,most:2/3*(1+1e-12),above:!0})||this.fault(t,xx,e))}vector(t,e,i){let[s,r]=i.counts??[3,3],o=i.each??_x;if(!Array.isArray(e)||e.length<s||e.length>r){this.fault(t,i.what??"3 numbers",e);return}e.forEach((a,c)=>this.field(`${t}[${c}]`,a,o)),i.nonzero&&e.every(a=>a===0)&&this.fault(t,"a direction, not all zero",e)}restitution(t,e){let i=this.layout.fields.restitution,s=xa(e)?e.form:void 0;typeof s=="string"&&Object.hasOwn(i,s)?this.table(t,e,i[s]):this.fault(`${t}.form`,`one of ${Object.keys(i).join(", ")}`,s??e)}};function Cd(n,t){let{fields:e}=t,i=new Mh(t);if(!xa(n))return i.fault("scene","a table of fields",n),i.faults;i.table("",n,e.scene),n.floor!==null&&i.table("floor",n.floor,e.floor),i.table("ball_contact",n.ball_contact,e.ball_contact),i.table("run",n.run,e.run);let[s,r]=[n.walls,n.balls];return Array.isArray(s)?s.forEach((o,a)=>{let c=xa(o)?o.shape:void 0;typeof c=="string"&&Object.hasOwn(e.walls,c)?i.table(`walls[${a}]`,o,e.walls[c]):i.fault(`walls[${a}].shape`,`one of ${Object.keys(e.walls).join(", ")}`,c)}):i.fault("walls","a list",s),!Array.isArray(r)||r.length===0?i.fault("balls","at least one ball",r):r.forEach((o,a)=>i.table(`balls[${a}]`,o,e.ball)),i.faults}var ya=1e-9,[Rd,Pd]=[100,2e3];function Dd(n,t){let e=Cd(t,n.layout);return e.length>0?e:(e.push(...bx(t),...Sx(t),...wx(t,n.layout)),e.length>0?e:Ax(n,t))}var Id=(n,t,e)=>0<t-n&&t-n<=360?[]:[`expected ${e} of more than 0 and at most 360 degrees`];function vx(n){let t=[],[e,i]=[se(n.low??"-inf"),se(n.height??"inf")];return n.shape==="wedge"&&t.push(...Id(n.from_angle,n.to_angle,"an opening")),n.shape==="arc"&&t.push(...Id(n.from_angle,n.to_angle,"an arc")),n.shape==="box"&&n.center===null==(n.corner===null)&&t.push("expected either center or corner"),n.shape==="segment"&&String(n.start)===String(n.end)&&t.push("expected another point than start"),n.shape==="cylinder"&&!(se(n.length)>0)&&t.push("expected a length greater than 0 m"),n.shape==="table"&&!(i>=(n.nose_height??0)&&i>0)&&t.push("expected a height above nose and floor"),"low"in n&&!(e<=i&&e<1/0&&i>-1/0)&&t.push(`expected a height above low = ${re(e,6)} m`),n.shape==="polygon"&&Mx(n.points,n.closed)&&t.push("expected an outline that does not meet itself"),t}function bx(n){let t=n.walls.flatMap((e,i)=>vx(e).map(s=>`walls[${i}]: ${s}`));return n.balls.forEach((e,i)=>{e.rolling&&e.spin!==null&&t.push(`balls[${i}].spin: expected no spin with rolling = true; it follows from the velocity`),e.rolling&&e.velocity[2]&&t.push(`balls[${i}].velocity: expected no speed along z with rolling = true`)}),n.balls.length>Rd&&t.push(`balls: expected at most ${Rd} in a page, got ${n.balls.length}; carom simulate takes more`),t}function Mx(n,t){let e=t?n.length:n.length-1,i=Array.from({length:e},(o,a)=>[n[a],n[(a+1)%n.length]]),s=(o,a,c)=>Math.sign((a[0]-o[0])*(c[1]-o[1])-(a[1]-o[1])*(c[0]-o[0])),r=(o,a,c)=>s(o,a,c)===0&&[0,1].every(l=>Math.min(o[l],a[l])<=c[l]&&c[l]<=Math.max(o[l],a[l]));return i.some(([o,a],c)=>String(o)===String(a)||i.slice(c+1).some(([l,h],u)=>{let f=s(o,a,l)*s(o,a,h)<0&&s(l,h,o)*s(l,h,a)<0,d=t&&c===0&&c+1+u===e-1;return f||!d&&(r(o,a,h)||r(l,h,o))}))}function Sx(n){let t=[],[e,i,s]=n.gravity;return n.floor&&(e!==0||i!==0||s>0)&&t.push(`gravity: expected gravity along -z, as there is a floor, got ${Os(n.gravity,6)}`),n.balls.forEach((r,o)=>{let[a,c]=[pa(n,r)[2],r.radius];n.floor&&a<c*(1-ya)?t.push(`balls[${o}].position[2]: expected z of at least the radius, ${re(c,6)}, got ${re(a,6)}, which overlaps the floor by ${Hn(c-a)}`):r.rolling&&!n.floor?t.push(`balls[${o}].rolling: expected a floor to roll on, got true in a scene without one`):r.rolling&&a>c*(1+ya)&&t.push(`balls[${o}].position[2]: expected z = radius = ${re(c,6)}, got ${re(a,6)} of a ball that rolls`)}),t}function wx(n,t){return n.walls.flatMap((e,i)=>Ex(n,e,dh(n,e,t),t).map(s=>`walls[${i}].${s}`))}function Ex(n,t,e,i){let s=[],r={restitution:"a number from 0 to 1, or a form",friction:"a number >= 0 (inf: never slips)"};for(let o of["restitution","friction"])e.needs.includes(o)&&t[o]===null&&s.push(`${o}: expected ${r[o]}, got nothing; the law ${e.name} reads it`);if(e.last==="stiffness_ratio"){let o=t.stiffness_ratio,[a,c]=e.chi_range??[0,1/0],l=n.balls.map(_=>(1+1/Gr(_))/2),[h,u]=[Math.max(...l.map(_=>a/_)),Math.min(...l.map(_=>c/_))];e.chi_range&&!(h<=o&&o<=u)&&s.push(`stiffness_ratio: expected a stiffness ratio from ${re(h,3)} to ${re(u,3)}, for which the law ${e.name} is tabulated, got ${re(o,6)}`);let{stiffness:f,most_omega:d}=i.limits,g=l.every(_=>Math.sqrt(o*2*_)<=d);!e.chi_range&&!(f[0]<=o&&o<=f[1]&&g)&&s.push(`stiffness_ratio: expected a stiffness ratio from ${f[0]} to ${f[1]} for the law ${e.name}, got ${re(o,6)}`),t.tangential_restitution!==0&&s.push(`tangential_restitution: expected 0 for the law ${e.name}, got ${re(t.tangential_restitution,6)}`)}if(e.response===i.responses.rolling){let o=t.restitution;o&&!(o.form==="constant"&&o.value===1)&&s.push(`restitution: expected hypothesis 3: a wall of restitution 1, for the law ${e.name}`),n.balls.every(a=>Us[t.shape].vertical(t,a.radius))||s.push(`shape: expected hypothesis 1: a vertical wall, for the law ${e.name}`)}return s}function Ax(n,t){let{memory:e,layout:i}=n,s=Ii(t,i,0);if(s.features.length>Pd)return[`walls: expected at most ${Pd} faces, edges and corners in a page, got ${s.features.length}; carom simulate takes more`];let r=Tx(t);if(r.length>0)return r;let o=t.balls.map(f=>pa(t,f)),a=t.walls.map((f,d)=>o.map((g,_)=>{let p=Us[f.shape].blocked(f,g);return p&&r.push(`balls[${_}].position: expected a place on the free side of ${Nd(f,d)}, got ${Os(g,6)}; move the ball`),p}));e.clear();let c=s.features.length,l=e.records(i.records.features,s.features),h=e.records(i.records.balls,s.balls),u=e.take(8*Math.max(c*o.length,1));return n.call("gaps",0,l,c,h,o.length,u,o.length,c),o.forEach((f,d)=>{let g=t.balls[d].radius,[_,p]=[-ya*g,-1];for(let m=0;m<c;m++){let y=e.doubles[u/8+d*c+m];y>=-g&&y<_&&!a[Number(s.features[m].wall)][d]&&([_,p]=[y,m])}if(p>=0){let m=Number(s.features[p].wall);r.push(Ld(d,f,Nd(t.walls[m],m),-_))}for(let m=0;m<d;m++){let y=g+t.balls[m].radius,S=Math.hypot(f[0]-o[m][0],f[1]-o[m][1],f[2]-o[m][2])-y;S<-ya*Math.min(g,t.balls[m].radius)&&r.push(Ld(d,f,`balls[${m}]`,-S))}}),r}var Ld=(n,t,e,i)=>`balls[${n}].position: expected a place where the ball touches nothing, got ${Os(t,6)}, which overlaps ${e} by ${Hn(i)}; move it by ${Hn(i)} or more`,Nd=(n,t)=>`walls[${t}] (${n.name??`${n.shape} ${t}`})`;function Tx(n){let t=n.balls.map(s=>s.radius),[e,i]=[Math.min(...t),Math.max(...t)];return n.walls.flatMap((s,r)=>{let o=Us[s.shape].room?.(s)??1/0;if(i>=o)return[`walls[${r}]: expected room for a ball of radius ${Hn(i)}, got room for radii below ${Hn(o)}`];let a=s.shape==="table"?s.nose_height:null;return a===null||a<2*e?[]:[`walls[${r}].nose_height: expected less than ${Hn(2*e)}, the diameter of a ball, which would roll under it, got ${re(a,6)}`]})}async function Ud(n,t){return new Wr(await _a(n,t))}var Wr=class{constructor(t){this.module=t,this.version=t.layout.version,this.laws=t.layout.laws}faults(t){return Dd(this.module,t)}run(t,e,i={}){return fd(this.module,this.checked(e===void 0?t:Cx(t,e)),i)}report(t,e,i={}){return Ed(t,this.run(t,e,i))}checked(t){let e=this.faults(t);if(e.length>0)throw new Error(e.join(`
`));return t}compare(t){return Sd(this.module,this.checked(t)).verdicts}meeting(t){return Hr(this.module,this.checked(t))}curve(t,e,i,s="final"){let r=this.laws.find(o=>o.name===t);if(r===void 0)throw new Error(`law: expected one of ${this.laws.map(o=>o.name).join(", ")}, got ${t}`);return wd(this.module,r,Hr(this.module,this.checked(e)),i,s)}},Cx=(n,t)=>({...n,run:{...n.run,law:t},walls:n.walls.map(e=>({...e,law:null}))});async function Od(n,t,e,i){return new Sh(await _a(n,t),e,await Rx(i.log),i)}async function Rx(n){if(typeof DecompressionStream>"u")throw new Error("This browser cannot unpack the run in this page: any browser since May 2023 can.");let t=Uint8Array.from(atob(n),i=>i.charCodeAt(0)),e=new Blob([t]).stream().pipeThrough(new DecompressionStream("gzip"));return new Uint8Array(await new Response(e).arrayBuffer())}var Sh=class extends Wr{constructor(t,e,i,s){super(t);let{memory:r,layout:o}=t;r.clear();let a=Ii({...e,walls:[]},o,0),c=r.records(o.records.world,[a.world]),l=r.records(o.records.balls,a.balls),h=r.take(i.length);new Uint8Array(r.memory.buffer,h,i.length).set(i);let u=[{at:h,rows:i.length/o.records.log.bytes}];this.found=mh(t,e,{world:c,balls:l,logs:u,status:s.status,end:s.end}),this.why=s.why}faults(){return[]}run(){return this.found}compare(t){try{return super.compare(t)}catch{throw new Error(this.why)}}};function Jt(n,t={},...e){let i=document.createElement(n);for(let[s,r]of Object.entries(t))typeof r=="function"?i.addEventListener(s,r):r===!0?i.setAttribute(s,""):r!==!1&&i.setAttribute(s,r);return i.append(...e),i}function Ve(n,t={},...e){let i=document.createElementNS("http://www.w3.org/2000/svg",n);for(let[s,r]of Object.entries(t))i.setAttribute(s,String(r));return i.append(...e),i}function Zt(n){let t=document.getElementById(n);if(!t)throw new Error(`the page has no element ${n}`);return t}function ai(n,t=3){return n==null||Number.isNaN(n)?"\u2013":n===1/0?"\u221E":n===-1/0?"\u2212\u221E":Math.abs(n)<1e-9?"0":(Math.abs(n)>=10**t?n.toFixed(0):String(Number(n.toPrecision(t)))).replace("-","\u2212")}function Fd(n){let t=Math.abs(n);return t<1e-9?"0 mm":t<.001?`${ai(n*1e6)} \xB5m`:t<1?`${ai(n*1e3)} mm`:`${ai(n)} m`}var Xr=n=>n!==0&&Math.abs(n)<.1?`${ai(n*1e3)} ms`:`${n.toFixed(3)} s`;var En=(n,t)=>[n[0]+t[0],n[1]+t[1],n[2]+t[2]];var rn=(n,t)=>[n[0]*t,n[1]*t,n[2]*t],Fs=(n,t)=>n[0]*t[0]+n[1]*t[1]+n[2]*t[2],va=(n,t)=>[n[1]*t[2]-n[2]*t[1],n[2]*t[0]-n[0]*t[2],n[0]*t[1]-n[1]*t[0]],An=n=>Math.hypot(n[0],n[1],n[2]),Ge=n=>{let t=An(n);return t>0?rn(n,1/t):[1,0,0]};var Px=.15,Ix=400;function zd(n,t){let e=0,i=n.length-1;for(;e<i;){let s=e+i+1>>1;n[s].t<=t?e=s:i=s-1}return e}function Bs(n,t){let{x:e,v:i,w:s,acc:r,turn:o}=n;return{x:[e[0]+t*(i[0]+.5*t*r[0]),e[1]+t*(i[1]+.5*t*r[1]),e[2]+t*(i[2]+.5*t*r[2])],v:[i[0]+t*r[0],i[1]+t*r[1],i[2]+t*r[2]],w:[s[0]+t*o[0],s[1]+t*o[1],s[2]+t*o[2]],phase:n.phase}}function Wn(n,t){let e=n[zd(n,t)];return Bs(e,Math.max(0,Math.min(t-e.t,e.lasts)))}function Lx(n,t){return[n[0]*t[0]-n[1]*t[1]-n[2]*t[2]-n[3]*t[3],n[0]*t[1]+n[1]*t[0]+n[2]*t[3]-n[3]*t[2],n[0]*t[2]-n[1]*t[3]+n[2]*t[0]+n[3]*t[1],n[0]*t[3]+n[1]*t[2]-n[2]*t[1]+n[3]*t[0]]}function Nx(n,t,e){let i=An(t),s=i*e/2;if(s===0)return n;let r=Math.sin(s)/i;return Lx([Math.cos(s),t[0]*r,t[1]*r,t[2]*r],n)}function Bd(n,t,e){let i=An(t.turn)>0,s=Math.max(An(t.w),An(Bs(t,e).w))*e,r=i?Math.min(Ix,Math.max(1,Math.ceil(s/Px))):1;for(let o=0;o<r;o++)n=Nx(n,Bs(t,(o+.5)*e/r).w,e/r);return n}var Li=class{constructor(t){this.pieces=t,this.starts=[[1,0,0,0]]}at(t){let{pieces:e,starts:i}=this,s=zd(e,t);for(;i.length<=s;){let r=e[i.length-1];i.push(Bd(i[i.length-1],r,Math.max(0,e[i.length].t-r.t)))}return Bd(i[s],e[s],Math.max(0,Math.min(t-e[s].t,e[s].lasts)))}};function Dx(n){return n==="flight"||n==="bouncing"||n==="left"?"flight":n==="sliding"?"sliding":"rolling"}var Ux={flight:.001,sliding:.02,rolling:.02};function ks(n,{from:t,until:e},i){let s=[];for(let r of n){let[o,a]=[Math.max(0,t-r.t),Math.min(r.lasts,e-r.t)],c=a-o;if(!(c>0))continue;let l=Dx(r.phase),{v:h,acc:u}=r,f=An(va(h,u))<1e-9*An(h)*An(u),d=An(u)*c*c/8,g=f?1:Math.max(1,Math.min(32,Math.ceil(Math.sqrt(d/(Ux[l]*i))))),_=s[s.length-1];(!_||_.style!==l)&&s.push(_={style:l,points:[Bs(r,o).x]});let p=f?-Fs(h,u)/Fs(u,u):0;p>o&&p<a&&_.points.push(Bs(r,p).x);for(let m=1;m<=g;m++)_.points.push(Bs(r,o+c*m/g).x)}return s}var kd=300;function Vd(n,{from:t,until:e}){let i=Math.max(0,...n?.balls.map(({pieces:s})=>s.length)??[]);return i>kd?.2*kd*(e-t)/i:1/0}var wh=n=>n==="solid"?2/5:n==="hollow"?2/3:n;function ba(n,t,e){let i=0;return n.balls.forEach((s,r)=>{let{x:o,v:a,w:c}=Wn(t.balls[r].pieces,e),l=wh(s.inertia)*s.mass*s.radius**2,h=n.floor?[0,0,o[2]-s.radius]:o;i+=(s.mass*Fs(a,a)+l*Fs(c,c))/2-s.mass*Fs(n.gravity,h)}),i}function Gd(n,t,{from:e,until:i},s){let r=new Set([i]);for(let a=0;a<s;a++)r.add(e+(i-e)*a/s);let o=4*s;for(let{t:a,lasts:c,acc:l}of n.balls[t].pieces){if(a>i||o<=0)break;if(!(a<e)){if(r.add(a),r.add(Math.min(i,a+c*(1-1e-9))),l[2]!==0&&c<(i-e)/20)for(let h=1;h<6;h++,o--)r.add(Math.min(i,a+c*h/6));o--}}return[...r].sort((a,c)=>a-c)}var as=n=>n==="inf"?1/0:n==="-inf"?-1/0:n??1/0,Xd=n=>n===1/0?"inf":n===-1/0?"-inf":n,wa=Math.PI/180;function yn(n,t,e){return{...n,balls:n.balls.map((i,s)=>s===t?{...i,...e}:i)}}function $d(n,t,e){return{...n,walls:n.walls.map((i,s)=>t<0||s===t?e(i):i)}}function Vs(n){let t=n.walls.find(s=>s.shape==="plane");if(!t)return null;let e=Ge(t.normal),i=Math.hypot(e[0],e[1]);return i>.3?[e[0]/i,e[1]/i,0]:null}function Ea(n,t){let[e,i]=n.balls[t].velocity;if(e===0&&i===0)return 0;let s=Vs(n);return s?Math.atan2(i*s[0]-e*s[1],-(e*s[0]+i*s[1]))/wa:Math.atan2(i,e)/wa}function Hd(n,t,e,i){let s=Vs(n),r=Math.cos(i*wa)*e,o=Math.sin(i*wa)*e,a=n.balls[t].velocity[2];return yn(n,t,{velocity:s?[-r*s[0]-o*s[1],-r*s[1]+o*s[0],a]:[r,o,a]})}function zs(n){return n.rolling?[-n.velocity[1]/n.radius,n.velocity[0]/n.radius,n.spin_z??0]:n.spin??[0,0,0]}function $r(n,t,e){let i=n.balls[t];if(!e)return yn(n,t,{rolling:e,spin:zs(i),spin_z:null});let[s,r]=i.velocity,[o,a]=i.position;return yn(n,t,{rolling:e,spin:null,spin_z:zs(i)[2],velocity:[s,r,0],position:[o,a,i.radius]})}function qd({velocity:[n,t]}){let e=Math.hypot(n,t),[i,s]=e>0?[n/e,t/e]:[1,0];return{top:[-s,i,0],way:[i,s,0]}}function Aa(n,t){let e=qd(n)[t],i=zs(n);return i[0]*e[0]+i[1]*e[1]}function Wd(n,t,e,i){let s=n.balls[t],r=qd(s),o=e==="top"?i:Aa(s,"top"),a=e==="way"?i:Aa(s,"way"),c=[0,1].map(h=>o*r.top[h]+a*r.way[h]),l=s.rolling?$r(n,t,!1):n;return yn(l,t,{spin:[c[0],c[1],zs(s)[2]]})}var Yd=n=>n.restitution?.form==="constant"?n.restitution.value??1:null,Zd=(n,t)=>n.walls[Math.max(t,0)];function Ox(n,t,e){let i=Zd(n,e);if(!i)return null;let s=n.balls[t].radius;if(i.shape==="table")return i.nose_height===null||i.nose_height===void 0?s:i.nose_height;if(i.shape!=="plane"||!n.floor)return null;let r=Ge(i.normal);return Math.hypot(r[0],r[1])>.05?s*(1-r[2]):null}function Fx(n,t,e,i){let s=n.balls[t].radius;return $d(n,e,r=>{if(r.shape==="table")return{...r,nose_height:i<=s*(1+1e-6)?null:i};if(r.shape!=="plane")return r;let o=Ge(r.normal),a=Math.hypot(o[0],o[1]),c=Math.max(-.95,Math.min(.95,1-i/s)),l=Math.sqrt(1-c*c);return a>.05?{...r,normal:[o[0]/a*l,o[1]/a*l,c]}:r})}function Bx(n,t,e){let i=n.balls[t],[s,r,o]=i.position,a=n.floor&&Math.abs(o-i.radius)<1e-9*i.radius;return yn(n,t,{radius:e,position:[s,r,a?e:Math.max(o,n.floor?e:o)]})}var Ma=n=>({read:(t,e,i)=>{let s=Zd(t,i);return s?n==="restitution"?s.restitution?Yd(s):1:as(s[n]):null},write:(t,e,i,s)=>$d(t,i,r=>({...r,[n]:n==="restitution"?{form:"constant",value:s}:Xd(s)}))}),Sa=n=>({read:({floor:t})=>t?n==="restitution"?Yd(t):as(t[n]):null,write:(t,e,i,s)=>t.floor?{...t,floor:{...t.floor,[n]:n==="restitution"?{form:"constant",value:s}:Xd(s)}}:t}),Jd=[{key:"speed",group:"Ball",label:"Speed",unit:"m/s",scale:1,least:0,most:8,step:.01,help:"along the floor",read:(n,t)=>Math.hypot(n.balls[t].velocity[0],n.balls[t].velocity[1]),write:(n,t,e,i)=>Hd(n,t,i,Ea(n,t))},{key:"angle",group:"Ball",label:"Angle",unit:"\xB0",scale:1,least:-180,most:180,step:.1,help:"from the wall's normal; without a plane wall from the x axis",read:Ea,write:(n,t,e,i)=>Hd(n,t,Math.hypot(n.balls[t].velocity[0],n.balls[t].velocity[1]),i)},{key:"topspin",group:"Ball",label:"Top / back spin",unit:"rad/s",scale:1,least:-200,most:200,step:.1,help:"positive as in rolling forward, negative: backspin; moving it ends rolling",read:(n,t)=>Aa(n.balls[t],"top"),write:(n,t,e,i)=>Wd(n,t,"top",i)},{key:"sidespin",group:"Ball",label:"Side spin",unit:"rad/s",scale:1,least:-200,most:200,step:.1,help:"about the vertical, counterclockwise as seen from above",read:(n,t)=>zs(n.balls[t])[2],write:(n,t,e,i)=>{let s=n.balls[t],[r,o]=zs(s);return yn(n,t,s.rolling?{spin_z:i}:{spin:[r,o,i]})}},{key:"massespin",group:"Ball",label:"Spin about the way",unit:"rad/s",scale:1,least:-200,most:200,step:.1,help:"about the direction of motion, as after a mass\xE9; moving it ends rolling",read:(n,t)=>Aa(n.balls[t],"way"),write:(n,t,e,i)=>Wd(n,t,"way",i)},{key:"height",group:"Ball",label:"Height",unit:"mm",scale:1e3,least:0,most:1,step:.001,help:"of its lowest point above the floor",read:(n,t)=>n.floor?Math.max(0,n.balls[t].position[2]-n.balls[t].radius):null,write:(n,t,e,i)=>{let s=i>0&&n.balls[t].rolling?$r(n,t,!1):n,{position:r,radius:o}=s.balls[t];return yn(s,t,{position:[r[0],r[1],o+Math.max(0,i)]})}},{key:"rise",group:"Ball",label:"Upward speed",unit:"m/s",scale:1,least:-5,most:5,step:.01,read:(n,t)=>n.balls[t].velocity[2],write:(n,t,e,i)=>{let s=i!==0&&n.balls[t].rolling?$r(n,t,!1):n,[r,o]=s.balls[t].velocity;return yn(s,t,{velocity:[r,o,i]})}},{key:"radius",group:"Ball",label:"Radius",unit:"mm",scale:1e3,least:.005,most:.08,step:25e-5,read:(n,t)=>n.balls[t].radius,write:(n,t,e,i)=>Bx(n,t,i)},{key:"inertia",group:"Ball",label:"Inertia I/(m a\xB2)",unit:"",scale:1,least:.01,most:.66,step:.01,help:"0.4: solid ball; 0.667: thin shell",read:(n,t)=>wh(n.balls[t].inertia),write:(n,t,e,i)=>yn(n,t,{inertia:Math.abs(i-2/3)<.001?2/3:i})},{key:"restitution",group:"Wall",label:"Restitution",unit:"",scale:1,least:0,most:1,step:.01,...Ma("restitution")},{key:"friction",group:"Wall",label:"Friction",unit:"",scale:1,least:0,most:1.5,step:.01,infinite:!0,help:"\u221E: never slips",...Ma("friction")},{key:"tangential_restitution",group:"Wall",label:"Tangential restitution",unit:"",scale:1,least:-1,most:1,step:.01,help:"0 stops the slip, 1 reverses it; maw and stronge compute it from the stiffness ratio",...Ma("tangential_restitution")},{key:"cushion_height",group:"Wall",label:"Cushion height",unit:"mm",scale:1e3,least:.01,most:.06,step:1e-4,help:"of the point where the wall touches the ball; at the ball's centre: an upright wall",read:Ox,write:Fx},{key:"stiffness_ratio",group:"Wall",label:"Stiffness ratio",unit:"",scale:1,least:.2,most:2,step:.01,help:"tangential over normal, of the laws maw and stronge",...Ma("stiffness_ratio")},{key:"floor_restitution",group:"Floor",label:"Restitution",unit:"",scale:1,least:0,most:.95,step:.01,...Sa("restitution")},{key:"floor_friction",group:"Floor",label:"Friction",unit:"",scale:1,least:0,most:1.5,step:.01,infinite:!0,help:"\u221E: never slips",...Sa("friction")},{key:"rolling_resistance",group:"Floor",label:"Rolling resistance",unit:"",scale:1,least:0,most:.05,step:5e-4,...Sa("rolling_resistance")},{key:"spin_friction",group:"Floor",label:"Spin friction",unit:"",scale:1,least:0,most:.05,step:5e-4,...Sa("spin_friction")}];function Kd(n,t){let{key:e,label:i,unit:s,scale:r}=n,o={speed:[0,1e3],rise:[-1e3,1e3],height:[0,1e3],radius:[1e-4,1],inertia:[.001,2/3+1e-9],restitution:[0,1],floor_restitution:[0,1],friction:[0,1/0],floor_friction:[0,1/0],tangential_restitution:[-1,1],stiffness_ratio:[.001,1e3],rolling_resistance:[0,10],spin_friction:[0,10],angle:[-360,360],cushion_height:[1e-4,1]},[a,c]=o[e]??[-1e5,1e5];if(t>=a&&t<=c)return null;let l=h=>h===1/0?"\u221E":String(Number((h*r).toPrecision(4)));return`${i}: expected a number from ${l(a)} to ${l(c)}${s?` ${s}`:""}.`}var jd={},Eh={},Ah=34,qr=10,Th=13;function tp(n){return new Function("d","return {"+n.map(function(t,e){return JSON.stringify(t)+": d["+e+'] || ""'}).join(",")+"}")}function kx(n,t){var e=tp(n);return function(i,s){return t(e(i),s,n)}}function Qd(n){var t=Object.create(null),e=[];return n.forEach(function(i){for(var s in i)s in t||e.push(t[s]=s)}),e}function on(n,t){var e=n+"",i=e.length;return i<t?new Array(t-i+1).join(0)+e:e}function zx(n){return n<0?"-"+on(-n,6):n>9999?"+"+on(n,6):on(n,4)}function Vx(n){var t=n.getUTCHours(),e=n.getUTCMinutes(),i=n.getUTCSeconds(),s=n.getUTCMilliseconds();return isNaN(n)?"Invalid Date":zx(n.getUTCFullYear(),4)+"-"+on(n.getUTCMonth()+1,2)+"-"+on(n.getUTCDate(),2)+(s?"T"+on(t,2)+":"+on(e,2)+":"+on(i,2)+"."+on(s,3)+"Z":i?"T"+on(t,2)+":"+on(e,2)+":"+on(i,2)+"Z":e||t?"T"+on(t,2)+":"+on(e,2)+"Z":"")}function ls(n){var t=new RegExp('["'+n+`
\r]`),e=n.charCodeAt(0);function i(u,f){var d,g,_=s(u,function(p,m){if(d)return d(p,m-1);g=p,d=f?kx(p,f):tp(p)});return _.columns=g||[],_}function s(u,f){var d=[],g=u.length,_=0,p=0,m,y=g<=0,S=!1;u.charCodeAt(g-1)===qr&&--g,u.charCodeAt(g-1)===Th&&--g;function v(){if(y)return Eh;if(S)return S=!1,jd;var E,x=_,w;if(u.charCodeAt(x)===Ah){for(;_++<g&&u.charCodeAt(_)!==Ah||u.charCodeAt(++_)===Ah;);return(E=_)>=g?y=!0:(w=u.charCodeAt(_++))===qr?S=!0:w===Th&&(S=!0,u.charCodeAt(_)===qr&&++_),u.slice(x+1,E-1).replace(/""/g,'"')}for(;_<g;){if((w=u.charCodeAt(E=_++))===qr)S=!0;else if(w===Th)S=!0,u.charCodeAt(_)===qr&&++_;else if(w!==e)continue;return u.slice(x,E)}return y=!0,u.slice(x,g)}for(;(m=v())!==Eh;){for(var A=[];m!==jd&&m!==Eh;)A.push(m),m=v();f&&(A=f(A,p++))==null||d.push(A)}return d}function r(u,f){return u.map(function(d){return f.map(function(g){return h(d[g])}).join(n)})}function o(u,f){return f==null&&(f=Qd(u)),[f.map(h).join(n)].concat(r(u,f)).join(`
`)}function a(u,f){return f==null&&(f=Qd(u)),r(u,f).join(`
`)}function c(u){return u.map(l).join(`
`)}function l(u){return u.map(h).join(n)}function h(u){return u==null?"":u instanceof Date?Vx(u):t.test(u+="")?'"'+u.replace(/"/g,'""')+'"':u}return{parse:i,parseRows:s,format:o,formatBody:a,formatRows:c,formatRow:l,formatValue:h}}var cs=ls(","),Gx=cs.parse,Ch=cs.parseRows,Hx=cs.format,Wx=cs.formatBody,Rh=cs.formatRows,Xx=cs.formatRow,$x=cs.formatValue;var hs=ls("	"),qx=hs.parse,Ph=hs.parseRows,Yx=hs.format,Zx=hs.formatBody,Jx=hs.formatRows,Kx=hs.formatRow,jx=hs.formatValue;var iy=/^[a-z0-9-_]+$/i,ep=!!"".isWellFormed;function Zr(n){let t=typeof n;if(t==="object"){if(Array.isArray(n))return"array";if(typeof n.getUTCDate=="function"&&n instanceof Date)return"date";if(globalThis.Temporal){if(n.until){if(n instanceof Temporal.ZonedDateTime)return"temporal/tz+uc";if(n instanceof Temporal.PlainDateTime||n instanceof Temporal.PlainDate)return"temporal/uc";if(n instanceof Temporal.PlainTime||n instanceof Temporal.Instant)return"temporal";if(n instanceof Temporal.PlainYearMonth)return"temporal/x"}else if(n.toPlainDate&&n instanceof Temporal.PlainMonthDay||n.negated&&n instanceof Temporal.Duration)return"temporal/x"}}return t}function sy(n){for(let t=0;t<n.length;t++)if(Zr(n[t])!=="object")return!1;return n.length!=0}function np(n){return JSON.stringify(n).replaceAll("\x7F","\\u007f")}function ry(n){return np(ep?n.toWellFormed():n)}function ip(n){if(iy.test(n))return n;if(ep&&!n.isWellFormed())throw new RangeError("key contains illegal lone surrogates");return np(n)}function Ih(n,t,e,i,s){if(e===0)throw new Error("Could not stringify the object: maximum object depth exceeded");switch(t){case"number":if(isNaN(n))return"nan";if(n===1/0)return"inf";if(n===-1/0)return"-inf";if(Number.isInteger(n)&&(i||!Number.isSafeInteger(n)))return n.toFixed(1);case"bigint":case"boolean":case"temporal":return n.toString();case"string":return ry(n);case"date":if(isNaN(n.getTime()))throw new TypeError("cannot serialize invalid date");return n.toISOString();case"object":return oy(n,e,i,s);case"array":return ay(n,e,i,s);case"temporal/tz+uc":if(s){let r=n.timeZoneId,o=r.charCodeAt(0);if(o!==43&&o!==45&&(o!==85&&o!==71&&o!==90&&o!==69||r!=="UTC"&&r!=="UCT"&&r!=="Universal"&&r!=="Zulu"&&!r.startsWith("GMT")&&r!=="Greenwich"&&!r.startsWith("Etc/")))throw new TypeError("Temporal objects with an IANA timezone are not allowed in Temporal strict mode")}case"temporal/uc":if(s&&n.calendarId!=="iso8601")throw new TypeError("Temporal objects with a non-default calendar are not allowed in Temporal strict mode");return n.toString({calendarName:"never",timeZoneName:"never"});case"temporal/x":throw new TypeError("Unsupported "+n[Symbol.toStringTag])}}function oy(n,t,e,i){let s=Object.keys(n);if(s.length===0)return"{}";let r="{ ";for(let o=0;o<s.length;o++){let a=s[o];o&&(r+=", "),r+=ip(a)+" = "+Ih(n[a],Zr(n[a]),t-1,e,i)}return r+" }"}function ay(n,t,e,i){if(n.length===0)return"[]";let s="[ ";for(let r=0;r<n.length;r++){if(r&&(s+=", "),n[r]===null||n[r]===void 0)throw new TypeError("arrays cannot contain null or undefined values");s+=Ih(n[r],Zr(n[r]),t-1,e,i)}return s+" ]"}function ly(n,t,e,i,s){if(e===0)throw new Error("Could not stringify the object: maximum object depth exceeded");let r="";for(let o=0;o<n.length;o++)r+=`${r&&`
`}[[${t}]]
`,r+=Lh(0,n[o],t,e,i,s);return r}function Lh(n,t,e,i,s,r){if(i===0)throw new Error("Could not stringify the object: maximum object depth exceeded");let o="",a="",c=Object.keys(t);for(let l=0;l<c.length;l++){let h=c[l];if(t[h]!==null&&t[h]!==void 0){let u=Zr(t[h]);if(u==="symbol"||u==="function")throw new TypeError(`cannot serialize values of type '${u}'`);let f=ip(h);if(u==="array"&&sy(t[h]))a+=(a&&`
`)+ly(t[h],e?`${e}.${f}`:f,i-1,s,r);else if(u==="object"){let d=e?`${e}.${f}`:f;a+=(a&&`
`)+Lh(d,t[h],d,i-1,s,r)}else o+=f,o+=" = ",o+=Ih(t[h],u,i,s,r),o+=`
`}}return n&&(o||!a)&&(o=o?`[${n}]
${o}`:`[${n}]`),o&&a?`${o}
${a}`:o||a}function Nh(n,{maxDepth:t=1e3,numbersAsFloat:e=!1,strictTemporal:i=!1}={}){if(Zr(n)!=="object")throw new TypeError("stringify can only be called with an object");let s=Lh(0,n,"",t,e,i);return s[s.length-1]!==`
`?s+`
`:s}function Uh(n){if(n==="inf")return 1/0;if(n==="-inf")return-1/0;if(Array.isArray(n))return n.map(Uh);if(n&&typeof n=="object"){let t=n;return t.form==="constant"&&"value"in t?t.value:Object.fromEntries(Object.entries(n).filter(([,e])=>e!=null).map(([e,i])=>[e,Uh(i)]))}return n}function op(n){let t=n.balls.map(({spin:i,spin_z:s,rolling:r,...o})=>({...o,rolling:r,...r?{spin_z:s}:{spin:i}})),e=Uh({...n,balls:t});return`# A scene of carom: carom simulate FILE, carom explore FILE. SI units.
${Nh(e,{numbersAsFloat:!1})}`}var sp=["x","y","z"];function ap(n,t){let e=(r,o="")=>sp.map(a=>`${r}${a}${o}`),i=["t","kind","ball","name","other","phase",...sp,...e("v","_before"),...e("w","_before"),...e("v"),...e("w"),"required_friction"],s=t.events.map(r=>[r.t,r.kind,r.ball,Jr(n,r.ball),r.other??-1,r.phase,...r.x,...r.v_before??[],...r.w_before??[],...r.v,...r.w,r.required??""]);return Rh([i,...s].map(r=>r.map(String)))}var Jr=(n,t)=>n.balls[t]?.name??`ball ${t}`,Oh=(n,t)=>n.walls[t]?.name??`${n.walls[t]?.shape??"wall"} ${t}`,cy={wall:"meets",ball:"meets",floor:"lands",rolling:"rolls",sliding:"slides",pivoting:"spins on the spot",rest:"comes to rest",settled:"bounces no more",left:"clears",held:"is held",flight:"flies",bouncing:"bounces",start:"starts"};function lp(n,t){let e=t.kind==="ball"?Jr(n,t.other??0):t.kind==="wall"||t.kind==="left"?Oh(n,t.other??0):"";return`${Jr(n,t.ball)} ${cy[t.kind]??t.kind} ${e}`.trim()}var hy=5e6,rp=2e4,Dh={m_s:1,cm_s:.01,mm_s:.001,km_h:1/3.6,ft_s:.3048,in_s:.0254,mph:.44704},Ta=["v_n_in","v_t_in","v_n_out","v_t_out"];function uy(n){let t=n.trim().toLowerCase(),e=/^(.*?)\s*[[(]([^\])]*)[\])]$/.exec(t),i=(e?e[1]:t).trim().replaceAll(" ","_").replace(/^v([nt])_/,"v_$1_").replace(/_derived$/,"");for(let s of Ta){if(e&&i===s){let r=Dh[e[2].trim().replace("/","_")];if(r===void 0)throw new Error(`Column ${JSON.stringify(n)}: expected a unit of speed, such as m/s or mm/s.`);return{name:s,factor:r}}if(i===s)return{name:s,factor:1};if(i.startsWith(`${s}_`)&&Dh[i.slice(s.length+1)]!==void 0)return{name:s,factor:Dh[i.slice(s.length+1)]}}return null}function cp(n){if(n.length>hy)throw new Error("This file is too large for the page: expected at most 5 MB.");if(n.includes("\0"))throw new Error("This file holds no text: expected a CSV table of rebounds.");let t=n.slice(0,n.search(/\r?\n|$/)),e=!t.includes(",")&&t.includes(";"),s=(e?l=>ls(";").parseRows(l):t.includes("	")&&!t.includes(",")?Ph:Ch)(n.replace(/^\uFEFF/,"")).filter(l=>l.some(h=>h.trim()));if(s.length<2)throw new Error("Expected a table of rebounds with a header and at least one row.");if(s.length>rp)throw new Error(`Expected at most ${rp} rows, got ${s.length-1}; carom fit takes more.`);let r=new Map,o=-1;s[0].forEach((l,h)=>{l.trim().toLowerCase()==="stage"&&(o=h);let u=uy(l);u&&r.set(u.name,{at:h,factor:u.factor})});let a=Ta.filter(l=>!r.has(l));if(a.length)throw new Error(`Expected a table of rebounds, with the columns ${Ta.join(", ")}; this one lacks ${a.join(", ")}.`);let c=[];if(s.slice(1).forEach((l,h)=>{let[u,f,d,g]=Ta.map(y=>{let{at:S,factor:v}=r.get(y),A=(l[S]??"").trim();if(!A)return NaN;let E=Number(e?A.replace(",","."):A);if(!Number.isFinite(E))throw new Error(`Row ${h+1}, ${y}: expected a number, got ${JSON.stringify(A.slice(0,30))}.`);return E*v}),_=f<0?-1:1,p=Math.atan2(_*f,u)*180/Math.PI,m=Math.atan2(_*g,d)*180/Math.PI;Number.isFinite(p)&&Number.isFinite(m)&&c.push({incidence:p,reflection:m,stage:o<0?"":(l[o]??"").trim().slice(0,20)})}),!c.length)throw new Error("Expected rows with all four speeds, got none.");return c}function hp(n,t,e,i){let s=!1,r=[],o=Jt("select",{id:"ball-choice","aria-label":"Ball",change:()=>t.change({ball:Number(o.value)},"scene","laws")}),a=Jt("select",{id:"wall-choice","aria-label":"Wall",change:()=>t.change({wall:Number(a.value)},"scene")}),c=Jt("input",{type:"checkbox",id:"rolling",change:()=>{t.remember(),e($r(t.state.scene,t.state.ball,c.checked))}}),l=(d,g)=>g===1/0?d.most+d.step*4:Math.max(d.least,Math.min(d.most,g));for(let d of["Ball","Wall","Floor"]){let g=Jt("section",{class:"controls","aria-label":d}),_=Jt("div",{class:"head"},Jt("h2",{},d));d==="Ball"&&_.append(o,Jt("label",{class:"check"},c,"rolling")),d==="Wall"&&_.append(a),g.append(_);for(let p of Jd.filter(m=>m.group===d)){let m=`control-${p.key}`,y=Jt("input",{type:"range",id:m,min:String(p.least),max:String(p.infinite?p.most+p.step*4:p.most),step:"any",change:()=>s=!1,input:()=>{s||t.remember(),s=!0;let A=Number(y.value),E=p.infinite&&A>p.most+p.step?1/0:Math.round(A/p.step)*p.step;h(p,E)}}),S=Jt("input",{type:"text",inputmode:"decimal",autocomplete:"off","aria-label":`${p.label}${p.unit?`, ${p.unit}`:""}`,id:`${m}-number`,change:()=>{let A=S.value.trim().replace("\u2212","-").replace(",","."),E=/^(inf|∞)$/i.test(A)?1/0:A===""?NaN:Number(A)/p.scale,x=Kd(p,E);if(x){i(x),f();return}t.remember(),h(p,E)}}),v=Jt("div",{class:"row",...p.help?{title:p.help}:{}},Jt("label",{for:m},p.label),y,S,Jt("span",{class:"unit"},p.unit));g.append(v),r.push({control:p,row:v,range:y,field:S})}n.append(g)}function h(d,g){let{scene:_,ball:p,wall:m}=t.state;e(d.write(_,p,m,g===1/0?g:Number(g.toPrecision(12))))}function u(d,g,_,p){let m=g.join(`
`);d.dataset.names!==m&&(d.replaceChildren(...g.map((y,S)=>Jt("option",{value:String(S+_)},y))),d.dataset.names=m),d.value=String(p),d.hidden=g.length<2}function f(){let{scene:d,ball:g,wall:_}=t.state;u(o,d.balls.map((p,m)=>Jr(d,m)),0,g),u(a,d.walls.length>1?["all walls",...d.walls.map((p,m)=>Oh(d,m))]:["wall"],-1,_),c.checked=d.balls[g].rolling,c.disabled=!d.floor;for(let{control:p,row:m,range:y,field:S}of r){let v=p.read(d,g,_);if(m.hidden=v===null,v===null)continue;if(p.key==="angle"){let E=Vs(d)?89.9:180;y.min=String(-E),y.max=String(E)}let A=v===1/0?"\u221E":String(Number((v*p.scale).toPrecision(4)));document.activeElement!==y&&(y.value=String(l(p,v))),y.setAttribute("aria-valuetext",`${A} ${p.unit}`.trim()),(document.activeElement!==S||S.dataset.said===S.value)&&(S.value=S.dataset.said=A)}for(let p of n.querySelectorAll("section"))p.hidden=[...p.querySelectorAll(".row")].every(m=>m.hidden)}return{update:f}}function fy(n,t){let e=document.createElementNS("http://www.w3.org/2000/svg","svg");e.setAttribute("viewBox","0 0 26 8"),e.setAttribute("class","sample"),e.setAttribute("aria-hidden","true");let i=document.createElementNS("http://www.w3.org/2000/svg","path");return i.setAttribute("d","M1 4H25"),i.setAttribute("stroke",n),i.setAttribute("stroke-width","3"),t&&i.setAttribute("stroke-dasharray",t.map(s=>s*2).join(" ")),e.append(i),e}function up(n,t){let e=Jt("p",{class:"nothing",hidden:!0});n.append(e);let i=t.state.cards.map(s=>{let r=Jt("input",{type:"checkbox",id:`law-${s.name}`,"aria-label":`show ${s.name}`,change:()=>{let{laws:f,followed:d}=t.state,g=t.state.cards.map(({name:_})=>_).filter(_=>_===s.name?r.checked:f.includes(_));t.change({laws:g,followed:g.includes(d)?d:g[0]??""},"laws")}}),o=Jt("button",{type:"button",class:"follow",title:`${s.summary} Press to follow its balls.`,click:()=>{let f=t.state.laws.includes(s.name)?t.state.laws:t.state.cards.map(({name:d})=>d).filter(d=>d===s.name||t.state.laws.includes(d));t.change({followed:s.name,laws:f},"laws")}},s.name),a=Jt("span",{class:"swatch"}),c=Jt("ul",{class:"why",hidden:!0,id:`why-${s.name}`}),l=Jt("button",{type:"button",class:"verdict","aria-controls":c.id,"aria-expanded":"false",click:()=>{c.hidden=!c.hidden,l.setAttribute("aria-expanded",String(!c.hidden))}}),h=Jt("dl",{}),u=Jt("article",{class:"law","data-law":s.name},Jt("header",{},r,a,o,l),c,h);return n.append(u),{card:s,box:r,follow:o,swatch:a,verdict:l,numbers:h,why:c,root:u}});return{update(s,r,o,a){e.textContent=a,e.hidden=!a;for(let{card:c,box:l,follow:h,swatch:u,verdict:f,numbers:d,why:g,root:_}of i){let p=s.get(c.name),m=o.get(c.name),y=r.get(c.name)??"currentColor",S=t.state.laws.includes(c.name);l.checked=S,_.style.setProperty("--law",y),_.classList.toggle("off",!S),_.classList.toggle("followed",t.state.followed===c.name),h.setAttribute("aria-pressed",String(t.state.followed===c.name)),u.replaceChildren(fy(y,c.dashes));let v=m?[m]:p?.reasons??[],A=p?.admissible&&!m;f.textContent=p||m?A?"\u2713 may apply":"\u2717 may not apply":"",f.className=`verdict ${A?"yes":"no"}`,f.disabled=v.length===0,f.title=v.join("; "),g.replaceChildren(...v.map(E=>Jt("li",{},E))),d.replaceChildren(...p?dy(p):[])}}}}function dy({angle:n,velocity:t,spin:e,energy_kept:i,hop:s,required:r,available:o}){return[["angle","angle",n===null?"\u2013":`${n.toFixed(1)}\xB0`],["energy","energy kept",i===null?"\u2013":`${(100*i).toFixed(1)} %`],["hop","hop",s===null?"\u2013":Fd(s)],["friction","\u03BC needed",r===null?"\u2013":`${ai(r,2)} of ${ai(o,2)}`],["velocity","velocity",t?`${t.map(c=>ai(c)).join(", ")} m/s`:"\u2013"],["spin","spin",e?`${e.map(c=>ai(c)).join(", ")} rad/s`:"\u2013"]].map(([c,l,h])=>Jt("div",{class:c},Jt("dt",{},l),Jt("dd",{},h)))}var py=2e3,my=600,Ni="as in the scene",li=n=>n instanceof Error?n.message:String(n);function Gs(n,t){let e=n.faults(t);if(e.length)throw new Error(e.slice(0,3).join(". ")+(e.length>3?`. (${e.length-3} more)`:""));return t}function Hs(n,t,e){let i={runs:new Map,notes:new Map,fault:null};for(let s of e)try{let r=n.run(t,s===Ni?void 0:s,{events:py,milliseconds:my/e.length});i.runs.set(s,r);let o=`after ${r.events.length} events, at ${Number(r.until.toPrecision(4))} s`;r.status==="refused"&&i.notes.set(s,r.why),!(r.events.length>=(t.run.max_events??1/0))&&(r.status==="limit"||r.status==="time")&&i.notes.set(s,`The run is cut off ${o}: carom simulate goes on.`)}catch(r){i.notes.set(s,li(r))}return e.length&&!i.runs.size&&(i.fault=[...i.notes.values()][0]),i}function Fh(n,t){try{return{verdicts:new Map(n.compare(t).map(e=>[e.law,e])),none:""}}catch(e){return{verdicts:new Map,none:li(e)}}}var fp=Array.from({length:30},(n,t)=>1+3*t);function dp(n,t,e){let i=new Map;for(let s of e)if(s!==Ni)try{i.set(s,n.curve(s,t,fp).map((r,o)=>[fp[o],r??NaN]))}catch{}return i}function Bh(n,t,e){if(e)return{from:e[0],until:e[1]};let i=0;for(let r of t){let o=r.events.at(-1)?.t??0,a=r.final.every(({phase:l})=>l==="rest"),c=r.status==="done"||r.status==="quiet";i=Math.max(i,a||!c?o:o*1.3+.3)}let s=n.run.duration;return{from:0,until:Math.max(1e-6,s===null?i||1:Math.min(i||s,s))}}function kh(n,t){let e=[];for(let i of t?.events??[])i.kind==="start"||i.kind==="ball"&&(i.other??0)<i.ball||e.push({t:i.t,text:lp(n,i)});return e}function pp(n,t){let e=n.filter(({name:s})=>s!==Ni);return t.walls.some(s=>s.law!==null&&s.law!==void 0)?[{name:Ni,summary:"Each wall with its own law.",valid:"",colour:"#777777",dashes:null,reads:null},...e]:e}function mp(n,t){return Vs(n)?Math.abs(Ea(n,t)):null}var gy=6e4;function gp({scene:n,laws:t,followed:e,t:i}){let s=new TextEncoder().encode(JSON.stringify({scene:n,laws:t,followed:e,t:Number(i.toPrecision(9))})),r="";for(let o of s)r+=String.fromCharCode(o);return`#s=${btoa(r).replaceAll("+","-").replaceAll("/","_").replace(/=+$/,"")}`}function zh(n,t,e){let i=new URLSearchParams(n.replace(/^#/,"")).get("s");if(i===null)return null;if(i.length>gy)throw new Error("This link is too long to be one of the explorer's.");let s;try{let l=atob(i.replaceAll("-","+").replaceAll("_","/"));s=JSON.parse(new TextDecoder("utf-8",{fatal:!0}).decode(Uint8Array.from(l,h=>h.charCodeAt(0))))}catch{throw new Error("This link is damaged: it may have been cut off when it was copied.")}if(typeof s!="object"||s===null)throw new Error("This link holds no scene.");let r=Gs(t,s.scene),o=Array.isArray(s.laws)?e.filter(l=>s.laws.includes(l)):e,a=e.includes(s.followed)?s.followed:"",c=typeof s.t=="number"&&s.t>=0&&s.t<1e6?s.t:0;return{scene:r,laws:o,followed:a,t:c}}function Vh(n,t){let e=URL.createObjectURL(t),i=Jt("a",{href:e,download:n});document.body.append(i),i.click(),i.remove(),setTimeout(()=>URL.revokeObjectURL(e),1e4)}function _p(n,t,e,i){let s=()=>{let{scene:l,laws:h,followed:u,t:f}=n.state;return gp({scene:l,laws:h,followed:u,t:f})},r=0;n.listen(l=>{document.documentElement.dataset.recorded||n.state.playing||l.size===1&&l.has("data")||(clearTimeout(r),r=window.setTimeout(()=>{try{history.replaceState(null,"",s())}catch{}},250))}),Zt("link").onclick=async()=>{let l=location.href.split("#")[0]+s();if(location.protocol==="about:"){i("A notebook's frame has no address: save the scene instead, or write the page with carom explore --out.");return}try{history.replaceState(null,"",s()),await navigator.clipboard.writeText(l),i("The link is copied.",!0)}catch{i("The link is in the address bar.",!0)}};let o=()=>document.querySelector("details.menu").removeAttribute("open");Zt("save-scene").onclick=()=>{let{scene:l,followed:h}=n.state,u=l.walls.some(f=>f.law)||!h;Vh("scene.toml",new Blob([op(u?l:{...l,run:{...l.run,law:h}})],{type:"application/toml"})),o()},Zt("save-events").onclick=()=>{let l=e();l?Vh("events.csv",new Blob([ap(n.state.scene,l)],{type:"text/csv"})):i("No law is shown: switch one on to save its events."),o()},Zt("save-picture").onclick=async()=>{o();try{Vh("scene.png",await t.picture())}catch(l){i(li(l))}};async function a(l){if(/\.toml$/i.test(l.name)){i("A scene is opened by carom explore FILE; here a table of measured rebounds (CSV) can be dropped.");return}try{if(l.size>2e7)throw new Error("This file is too large for the page: expected at most 5 MB.");let h=cp(await l.text());n.change({rebounds:h,reboundsFrom:l.name},"data"),i(`${h.length} measured rebounds from ${l.name}.`,!0)}catch(h){i(`${l.name}: ${li(h)}`)}}addEventListener("dragover",l=>{l.preventDefault(),document.body.classList.add("dropping")}),addEventListener("dragleave",l=>{l.relatedTarget||document.body.classList.remove("dropping")}),addEventListener("drop",l=>{l.preventDefault(),document.body.classList.remove("dropping");let h=l.dataTransfer?.files[0];h&&a(h)});let c=Zt("file");c.onchange=()=>{c.files?.[0]&&a(c.files[0]),c.value=""}}function Ca(n,t){return n==null||t==null?NaN:n<t?-1:n>t?1:n>=t?0:NaN}function _y(n,t){return n==null||t==null?NaN:t<n?-1:t>n?1:t>=n?0:NaN}function xp(n){let t,e,i;n.length!==2?(t=Ca,e=(a,c)=>Ca(n(a),c),i=(a,c)=>n(a)-c):(t=n===Ca||n===_y?n:xy,e=n,i=n);function s(a,c,l=0,h=a.length){if(l<h){if(t(c,c)!==0)return h;do{let u=l+h>>>1;e(a[u],c)<0?l=u+1:h=u}while(l<h)}return l}function r(a,c,l=0,h=a.length){if(l<h){if(t(c,c)!==0)return h;do{let u=l+h>>>1;e(a[u],c)<=0?l=u+1:h=u}while(l<h)}return l}function o(a,c,l=0,h=a.length){let u=s(a,c,l,h-1);return u>l&&i(a[u-1],c)>-i(a[u],c)?u-1:u}return{left:s,center:o,right:r}}function xy(){return 0}function yy(n){return n===null?NaN:+n}var yp=xp(Ca),vp=yp.right,aC=yp.left,lC=xp(yy).center;var cC=bp(Mp),hC=bp(vy);function bp(n){return function(t,e,i=e){if(!((e=+e)>=0))throw new RangeError("invalid rx");if(!((i=+i)>=0))throw new RangeError("invalid ry");let{data:s,width:r,height:o}=t;if(!((r=Math.floor(r))>=0))throw new RangeError("invalid width");if(!((o=Math.floor(o!==void 0?o:s.length/r))>=0))throw new RangeError("invalid height");if(!r||!o||!e&&!i)return t;let a=e&&n(e),c=i&&n(i),l=s.slice();return a&&c?(Ws(a,l,s,r,o),Ws(a,s,l,r,o),Ws(a,l,s,r,o),Xs(c,s,l,r,o),Xs(c,l,s,r,o),Xs(c,s,l,r,o)):a?(Ws(a,s,l,r,o),Ws(a,l,s,r,o),Ws(a,s,l,r,o)):c&&(Xs(c,s,l,r,o),Xs(c,l,s,r,o),Xs(c,s,l,r,o)),t}}function Ws(n,t,e,i,s){for(let r=0,o=i*s;r<o;)n(t,e,r,r+=i,1)}function Xs(n,t,e,i,s){for(let r=0,o=i*s;r<i;++r)n(t,e,r,r+o,i)}function vy(n){let t=Mp(n);return(e,i,s,r,o)=>{s<<=2,r<<=2,o<<=2,t(e,i,s+0,r+0,o),t(e,i,s+1,r+1,o),t(e,i,s+2,r+2,o),t(e,i,s+3,r+3,o)}}function Mp(n){let t=Math.floor(n);if(t===n)return by(n);let e=n-t,i=2*n+1;return(s,r,o,a,c)=>{if(!((a-=c)>=o))return;let l=t*r[o],h=c*t,u=h+c;for(let f=o,d=o+h;f<d;f+=c)l+=r[Math.min(a,f)];for(let f=o,d=a;f<=d;f+=c)l+=r[Math.min(a,f+h)],s[f]=(l+e*(r[Math.max(o,f-u)]+r[Math.min(a,f+u)]))/i,l-=r[Math.max(o,f-h)]}}function by(n){let t=2*n+1;return(e,i,s,r,o)=>{if(!((r-=o)>=s))return;let a=n*i[s],c=o*n;for(let l=s,h=s+c;l<h;l+=o)a+=i[Math.min(r,l)];for(let l=s,h=r;l<=h;l+=o)a+=i[Math.min(r,l+c)],e[l]=a/t,a-=i[Math.max(s,l-c)]}}var My=Array.prototype,uC=My.slice;var Sy=Math.sqrt(50),wy=Math.sqrt(10),Ey=Math.sqrt(2);function Ra(n,t,e){let i=(t-n)/Math.max(0,e),s=Math.floor(Math.log10(i)),r=i/Math.pow(10,s),o=r>=Sy?10:r>=wy?5:r>=Ey?2:1,a,c,l;return s<0?(l=Math.pow(10,-s)/o,a=Math.round(n*l),c=Math.round(t*l),a/l<n&&++a,c/l>t&&--c,l=-l):(l=Math.pow(10,s)*o,a=Math.round(n/l),c=Math.round(t/l),a*l<n&&++a,c*l>t&&--c),c<a&&.5<=e&&e<2?Ra(n,t,e*2):[a,c,l]}function Sp(n,t,e){if(t=+t,n=+n,e=+e,!(e>0))return[];if(n===t)return[n];let i=t<n,[s,r,o]=i?Ra(t,n,e):Ra(n,t,e);if(!(r>=s))return[];let a=r-s+1,c=new Array(a);if(i)if(o<0)for(let l=0;l<a;++l)c[l]=(r-l)/-o;else for(let l=0;l<a;++l)c[l]=(r-l)*o;else if(o<0)for(let l=0;l<a;++l)c[l]=(s+l)/-o;else for(let l=0;l<a;++l)c[l]=(s+l)*o;return c}function Pa(n,t,e){return t=+t,n=+n,e=+e,Ra(n,t,e)[2]}function wp(n,t,e){t=+t,n=+n,e=+e;let i=t<n,s=i?Pa(t,n,e):Pa(n,t,e);return(i?-1:1)*(s<0?1/-s:s)}var fC=Ay(Math.random);function Ay(n){return function(e,i=0,s=e.length){let r=s-(i=+i);for(;r;){let o=n()*r--|0,a=e[r+i];e[r+i]=e[o+i],e[o+i]=a}return e}}function Ep(n,t){switch(arguments.length){case 0:break;case 1:this.range(n);break;default:this.range(t).domain(n);break}return this}function Zs(n,t,e){n.prototype=t.prototype=e,e.constructor=n}function Qr(n,t){var e=Object.create(n.prototype);for(var i in t)e[i]=t[i];return e}function Di(){}var ps=.7,Ys=1/ps,$s="\\s*([+-]?\\d+)\\s*",Kr="\\s*([+-]?(?:\\d*\\.)?\\d+(?:[eE][+-]?\\d+)?)\\s*",Xn="\\s*([+-]?(?:\\d*\\.)?\\d+(?:[eE][+-]?\\d+)?)%\\s*",Ty=/^#([0-9a-f]{3,8})$/,Cy=new RegExp(`^rgb\\(${$s},${$s},${$s}\\)$`),Ry=new RegExp(`^rgb\\(${Xn},${Xn},${Xn}\\)$`),Py=new RegExp(`^rgba\\(${$s},${$s},${$s},${Kr}\\)$`),Iy=new RegExp(`^rgba\\(${Xn},${Xn},${Xn},${Kr}\\)$`),Ly=new RegExp(`^hsl\\(${Kr},${Xn},${Xn}\\)$`),Ny=new RegExp(`^hsla\\(${Kr},${Xn},${Xn},${Kr}\\)$`),Ap={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074};Zs(Di,Js,{copy(n){return Object.assign(new this.constructor,this,n)},displayable(){return this.rgb().displayable()},hex:Tp,formatHex:Tp,formatHex8:Dy,formatHsl:Uy,formatRgb:Cp,toString:Cp});function Tp(){return this.rgb().formatHex()}function Dy(){return this.rgb().formatHex8()}function Uy(){return Fp(this).formatHsl()}function Cp(){return this.rgb().formatRgb()}function Js(n){var t,e;return n=(n+"").trim().toLowerCase(),(t=Ty.exec(n))?(e=t[1].length,t=parseInt(t[1],16),e===6?Rp(t):e===3?new Re(t>>8&15|t>>4&240,t>>4&15|t&240,(t&15)<<4|t&15,1):e===8?Ia(t>>24&255,t>>16&255,t>>8&255,(t&255)/255):e===4?Ia(t>>12&15|t>>8&240,t>>8&15|t>>4&240,t>>4&15|t&240,((t&15)<<4|t&15)/255):null):(t=Cy.exec(n))?new Re(t[1],t[2],t[3],1):(t=Ry.exec(n))?new Re(t[1]*255/100,t[2]*255/100,t[3]*255/100,1):(t=Py.exec(n))?Ia(t[1],t[2],t[3],t[4]):(t=Iy.exec(n))?Ia(t[1]*255/100,t[2]*255/100,t[3]*255/100,t[4]):(t=Ly.exec(n))?Lp(t[1],t[2]/100,t[3]/100,1):(t=Ny.exec(n))?Lp(t[1],t[2]/100,t[3]/100,t[4]):Ap.hasOwnProperty(n)?Rp(Ap[n]):n==="transparent"?new Re(NaN,NaN,NaN,0):null}function Rp(n){return new Re(n>>16&255,n>>8&255,n&255,1)}function Ia(n,t,e,i){return i<=0&&(n=t=e=NaN),new Re(n,t,e,i)}function qh(n){return n instanceof Di||(n=Js(n)),n?(n=n.rgb(),new Re(n.r,n.g,n.b,n.opacity)):new Re}function to(n,t,e,i){return arguments.length===1?qh(n):new Re(n,t,e,i??1)}function Re(n,t,e,i){this.r=+n,this.g=+t,this.b=+e,this.opacity=+i}Zs(Re,to,Qr(Di,{brighter(n){return n=n==null?Ys:Math.pow(Ys,n),new Re(this.r*n,this.g*n,this.b*n,this.opacity)},darker(n){return n=n==null?ps:Math.pow(ps,n),new Re(this.r*n,this.g*n,this.b*n,this.opacity)},rgb(){return this},clamp(){return new Re(fs(this.r),fs(this.g),fs(this.b),Na(this.opacity))},displayable(){return-.5<=this.r&&this.r<255.5&&-.5<=this.g&&this.g<255.5&&-.5<=this.b&&this.b<255.5&&0<=this.opacity&&this.opacity<=1},hex:Pp,formatHex:Pp,formatHex8:Oy,formatRgb:Ip,toString:Ip}));function Pp(){return`#${us(this.r)}${us(this.g)}${us(this.b)}`}function Oy(){return`#${us(this.r)}${us(this.g)}${us(this.b)}${us((isNaN(this.opacity)?1:this.opacity)*255)}`}function Ip(){let n=Na(this.opacity);return`${n===1?"rgb(":"rgba("}${fs(this.r)}, ${fs(this.g)}, ${fs(this.b)}${n===1?")":`, ${n})`}`}function Na(n){return isNaN(n)?1:Math.max(0,Math.min(1,n))}function fs(n){return Math.max(0,Math.min(255,Math.round(n)||0))}function us(n){return n=fs(n),(n<16?"0":"")+n.toString(16)}function Lp(n,t,e,i){return i<=0?n=t=e=NaN:e<=0||e>=1?n=t=NaN:t<=0&&(n=NaN),new Tn(n,t,e,i)}function Fp(n){if(n instanceof Tn)return new Tn(n.h,n.s,n.l,n.opacity);if(n instanceof Di||(n=Js(n)),!n)return new Tn;if(n instanceof Tn)return n;n=n.rgb();var t=n.r/255,e=n.g/255,i=n.b/255,s=Math.min(t,e,i),r=Math.max(t,e,i),o=NaN,a=r-s,c=(r+s)/2;return a?(t===r?o=(e-i)/a+(e<i)*6:e===r?o=(i-t)/a+2:o=(t-e)/a+4,a/=c<.5?r+s:2-r-s,o*=60):a=c>0&&c<1?0:o,new Tn(o,a,c,n.opacity)}function Ua(n,t,e,i){return arguments.length===1?Fp(n):new Tn(n,t,e,i??1)}function Tn(n,t,e,i){this.h=+n,this.s=+t,this.l=+e,this.opacity=+i}Zs(Tn,Ua,Qr(Di,{brighter(n){return n=n==null?Ys:Math.pow(Ys,n),new Tn(this.h,this.s,this.l*n,this.opacity)},darker(n){return n=n==null?ps:Math.pow(ps,n),new Tn(this.h,this.s,this.l*n,this.opacity)},rgb(){var n=this.h%360+(this.h<0)*360,t=isNaN(n)||isNaN(this.s)?0:this.s,e=this.l,i=e+(e<.5?e:1-e)*t,s=2*e-i;return new Re(Gh(n>=240?n-240:n+120,s,i),Gh(n,s,i),Gh(n<120?n+240:n-120,s,i),this.opacity)},clamp(){return new Tn(Np(this.h),La(this.s),La(this.l),Na(this.opacity))},displayable(){return(0<=this.s&&this.s<=1||isNaN(this.s))&&0<=this.l&&this.l<=1&&0<=this.opacity&&this.opacity<=1},formatHsl(){let n=Na(this.opacity);return`${n===1?"hsl(":"hsla("}${Np(this.h)}, ${La(this.s)*100}%, ${La(this.l)*100}%${n===1?")":`, ${n})`}`}}));function Np(n){return n=(n||0)%360,n<0?n+360:n}function La(n){return Math.max(0,Math.min(1,n||0))}function Gh(n,t,e){return(n<60?t+(e-t)*n/60:n<180?e:n<240?t+(e-t)*(240-n)/60:t)*255}var Bp=Math.PI/180,kp=180/Math.PI,Da=18,zp=.96422,Vp=1,Gp=.82521,Hp=4/29,qs=6/29,Wp=3*qs*qs,Fy=qs*qs*qs;function Xp(n){if(n instanceof $n)return new $n(n.l,n.a,n.b,n.opacity);if(n instanceof ci)return qp(n);n instanceof Re||(n=qh(n));var t=$h(n.r),e=$h(n.g),i=$h(n.b),s=Hh((.2225045*t+.7168786*e+.0606169*i)/Vp),r,o;return t===e&&e===i?r=o=s:(r=Hh((.4360747*t+.3850649*e+.1430804*i)/zp),o=Hh((.0139322*t+.0971045*e+.7141733*i)/Gp)),new $n(116*s-16,500*(r-s),200*(s-o),n.opacity)}function $p(n,t,e,i){return arguments.length===1?Xp(n):new $n(n,t,e,i??1)}function $n(n,t,e,i){this.l=+n,this.a=+t,this.b=+e,this.opacity=+i}Zs($n,$p,Qr(Di,{brighter(n){return new $n(this.l+Da*(n??1),this.a,this.b,this.opacity)},darker(n){return new $n(this.l-Da*(n??1),this.a,this.b,this.opacity)},rgb(){var n=(this.l+16)/116,t=isNaN(this.a)?n:n+this.a/500,e=isNaN(this.b)?n:n-this.b/200;return t=zp*Wh(t),n=Vp*Wh(n),e=Gp*Wh(e),new Re(Xh(3.1338561*t-1.6168667*n-.4906146*e),Xh(-.9787684*t+1.9161415*n+.033454*e),Xh(.0719453*t-.2289914*n+1.4052427*e),this.opacity)}}));function Hh(n){return n>Fy?Math.pow(n,1/3):n/Wp+Hp}function Wh(n){return n>qs?n*n*n:Wp*(n-Hp)}function Xh(n){return 255*(n<=.0031308?12.92*n:1.055*Math.pow(n,1/2.4)-.055)}function $h(n){return(n/=255)<=.04045?n/12.92:Math.pow((n+.055)/1.055,2.4)}function By(n){if(n instanceof ci)return new ci(n.h,n.c,n.l,n.opacity);if(n instanceof $n||(n=Xp(n)),n.a===0&&n.b===0)return new ci(NaN,0<n.l&&n.l<100?0:NaN,n.l,n.opacity);var t=Math.atan2(n.b,n.a)*kp;return new ci(t<0?t+360:t,Math.sqrt(n.a*n.a+n.b*n.b),n.l,n.opacity)}function Oa(n,t,e,i){return arguments.length===1?By(n):new ci(n,t,e,i??1)}function ci(n,t,e,i){this.h=+n,this.c=+t,this.l=+e,this.opacity=+i}function qp(n){if(isNaN(n.h))return new $n(n.l,0,0,n.opacity);var t=n.h*Bp;return new $n(n.l,Math.cos(t)*n.c,Math.sin(t)*n.c,n.opacity)}Zs(ci,Oa,Qr(Di,{brighter(n){return new ci(this.h,this.c,this.l+Da*(n??1),this.opacity)},darker(n){return new ci(this.h,this.c,this.l-Da*(n??1),this.opacity)},rgb(){return qp(this).rgb()}}));var Yp=-.14861,Yh=1.78277,Zh=-.29227,Fa=-.90649,jr=1.97294,Dp=jr*Fa,Up=jr*Yh,Op=Yh*Zh-Fa*Yp;function ky(n){if(n instanceof ds)return new ds(n.h,n.s,n.l,n.opacity);n instanceof Re||(n=qh(n));var t=n.r/255,e=n.g/255,i=n.b/255,s=(Op*i+Dp*t-Up*e)/(Op+Dp-Up),r=i-s,o=(jr*(e-s)-Zh*r)/Fa,a=Math.sqrt(o*o+r*r)/(jr*s*(1-s)),c=a?Math.atan2(o,r)*kp-120:NaN;return new ds(c<0?c+360:c,a,s,n.opacity)}function Ba(n,t,e,i){return arguments.length===1?ky(n):new ds(n,t,e,i??1)}function ds(n,t,e,i){this.h=+n,this.s=+t,this.l=+e,this.opacity=+i}Zs(ds,Ba,Qr(Di,{brighter(n){return n=n==null?Ys:Math.pow(Ys,n),new ds(this.h,this.s,this.l*n,this.opacity)},darker(n){return n=n==null?ps:Math.pow(ps,n),new ds(this.h,this.s,this.l*n,this.opacity)},rgb(){var n=isNaN(this.h)?0:(this.h+120)*Bp,t=+this.l,e=isNaN(this.s)?0:this.s*t*(1-t),i=Math.cos(n),s=Math.sin(n);return new Re(255*(t+e*(Yp*i+Yh*s)),255*(t+e*(Zh*i+Fa*s)),255*(t+e*(jr*i)),this.opacity)}}));function jp(n,t,e,i,s){var r=n*n,o=r*n;return((1-3*n+3*r-o)*t+(4-6*r+3*o)*e+(1+3*n+3*r-3*o)*i+o*s)/6}function zy(n){var t=n.length-1;return function(e){var i=e<=0?e=0:e>=1?(e=1,t-1):Math.floor(e*t),s=n[i],r=n[i+1],o=i>0?n[i-1]:2*s-r,a=i<t-1?n[i+2]:2*r-s;return jp((e-i/t)*t,o,s,r,a)}}function Vy(n){var t=n.length;return function(e){var i=Math.floor(((e%=1)<0?++e:e)*t),s=n[(i+t-1)%t],r=n[i%t],o=n[(i+1)%t],a=n[(i+2)%t];return jp((e-i/t)*t,s,r,o,a)}}var za=n=>()=>n;function Qp(n,t){return function(e){return n+e*t}}function Gy(n,t,e){return n=Math.pow(n,e),t=Math.pow(t,e)-n,e=1/e,function(i){return Math.pow(n+i*t,e)}}function Qh(n,t){var e=t-n;return e?Qp(n,e>180||e<-180?e-360*Math.round(e/360):e):za(isNaN(n)?t:n)}function Hy(n){return(n=+n)==1?an:function(t,e){return e-t?Gy(t,e,n):za(isNaN(t)?e:t)}}function an(n,t){var e=t-n;return e?Qp(n,e):za(isNaN(n)?t:n)}var Zp=(function n(t){var e=Hy(t);function i(s,r){var o=e((s=to(s)).r,(r=to(r)).r),a=e(s.g,r.g),c=e(s.b,r.b),l=an(s.opacity,r.opacity);return function(h){return s.r=o(h),s.g=a(h),s.b=c(h),s.opacity=l(h),s+""}}return i.gamma=n,i})(1);function tm(n){return function(t){var e=t.length,i=new Array(e),s=new Array(e),r=new Array(e),o,a;for(o=0;o<e;++o)a=to(t[o]),i[o]=a.r||0,s[o]=a.g||0,r[o]=a.b||0;return i=n(i),s=n(s),r=n(r),a.opacity=1,function(c){return a.r=i(c),a.g=s(c),a.b=r(c),a+""}}}var _C=tm(zy),xC=tm(Vy);function Wy(n,t){t||(t=[]);var e=n?Math.min(t.length,n.length):0,i=t.slice(),s;return function(r){for(s=0;s<e;++s)i[s]=n[s]*(1-r)+t[s]*r;return i}}function Xy(n){return ArrayBuffer.isView(n)&&!(n instanceof DataView)}function $y(n,t){var e=t?t.length:0,i=n?Math.min(e,n.length):0,s=new Array(i),r=new Array(e),o;for(o=0;o<i;++o)s[o]=Va(n[o],t[o]);for(;o<e;++o)r[o]=t[o];return function(a){for(o=0;o<i;++o)r[o]=s[o](a);return r}}function qy(n,t){var e=new Date;return n=+n,t=+t,function(i){return e.setTime(n*(1-i)+t*i),e}}function Cn(n,t){return n=+n,t=+t,function(e){return n*(1-e)+t*e}}function Yy(n,t){var e={},i={},s;(n===null||typeof n!="object")&&(n={}),(t===null||typeof t!="object")&&(t={});for(s in t)s in n?e[s]=Va(n[s],t[s]):i[s]=t[s];return function(r){for(s in e)i[s]=e[s](r);return i}}var Kh=/[-+]?(?:\d+\.?\d*|\.?\d+)(?:[eE][-+]?\d+)?/g,Jh=new RegExp(Kh.source,"g");function Zy(n){return function(){return n}}function Jy(n){return function(t){return n(t)+""}}function Ky(n,t){var e=Kh.lastIndex=Jh.lastIndex=0,i,s,r,o=-1,a=[],c=[];for(n=n+"",t=t+"";(i=Kh.exec(n))&&(s=Jh.exec(t));)(r=s.index)>e&&(r=t.slice(e,r),a[o]?a[o]+=r:a[++o]=r),(i=i[0])===(s=s[0])?a[o]?a[o]+=s:a[++o]=s:(a[++o]=null,c.push({i:o,x:Cn(i,s)})),e=Jh.lastIndex;return e<t.length&&(r=t.slice(e),a[o]?a[o]+=r:a[++o]=r),a.length<2?c[0]?Jy(c[0].x):Zy(t):(t=c.length,function(l){for(var h=0,u;h<t;++h)a[(u=c[h]).i]=u.x(l);return a.join("")})}function Va(n,t){var e=typeof t,i;return t==null||e==="boolean"?za(t):(e==="number"?Cn:e==="string"?(i=Js(t))?(t=i,Zp):Ky:t instanceof Js?Zp:t instanceof Date?qy:Xy(t)?Wy:Array.isArray(t)?$y:typeof t.valueOf!="function"&&typeof t.toString!="function"||isNaN(t)?Yy:Cn)(n,t)}function em(n,t){return n=+n,t=+t,function(e){return Math.round(n*(1-e)+t*e)}}var Jp=180/Math.PI,jh={translateX:0,translateY:0,rotate:0,skewX:0,scaleX:1,scaleY:1};function nm(n,t,e,i,s,r){var o,a,c;return(o=Math.sqrt(n*n+t*t))&&(n/=o,t/=o),(c=n*e+t*i)&&(e-=n*c,i-=t*c),(a=Math.sqrt(e*e+i*i))&&(e/=a,i/=a,c/=a),n*i<t*e&&(n=-n,t=-t,c=-c,o=-o),{translateX:s,translateY:r,rotate:Math.atan2(t,n)*Jp,skewX:Math.atan(c)*Jp,scaleX:o,scaleY:a}}var ka;function jy(n){let t=new(typeof DOMMatrix=="function"?DOMMatrix:WebKitCSSMatrix)(n+"");return t.isIdentity?jh:nm(t.a,t.b,t.c,t.d,t.e,t.f)}function Qy(n){return n==null||(ka||(ka=document.createElementNS("http://www.w3.org/2000/svg","g")),ka.setAttribute("transform",n),!(n=ka.transform.baseVal.consolidate()))?jh:(n=n.matrix,nm(n.a,n.b,n.c,n.d,n.e,n.f))}function im(n,t,e,i){function s(l){return l.length?l.pop()+" ":""}function r(l,h,u,f,d,g){if(l!==u||h!==f){var _=d.push("translate(",null,t,null,e);g.push({i:_-4,x:Cn(l,u)},{i:_-2,x:Cn(h,f)})}else(u||f)&&d.push("translate("+u+t+f+e)}function o(l,h,u,f){l!==h?(l-h>180?h+=360:h-l>180&&(l+=360),f.push({i:u.push(s(u)+"rotate(",null,i)-2,x:Cn(l,h)})):h&&u.push(s(u)+"rotate("+h+i)}function a(l,h,u,f){l!==h?f.push({i:u.push(s(u)+"skewX(",null,i)-2,x:Cn(l,h)}):h&&u.push(s(u)+"skewX("+h+i)}function c(l,h,u,f,d,g){if(l!==u||h!==f){var _=d.push(s(d)+"scale(",null,",",null,")");g.push({i:_-4,x:Cn(l,u)},{i:_-2,x:Cn(h,f)})}else(u!==1||f!==1)&&d.push(s(d)+"scale("+u+","+f+")")}return function(l,h){var u=[],f=[];return l=n(l),h=n(h),r(l.translateX,l.translateY,h.translateX,h.translateY,u,f),o(l.rotate,h.rotate,u,f),a(l.skewX,h.skewX,u,f),c(l.scaleX,l.scaleY,h.scaleX,h.scaleY,u,f),l=h=null,function(d){for(var g=-1,_=f.length,p;++g<_;)u[(p=f[g]).i]=p.x(d);return u.join("")}}}var yC=im(jy,"px, ","px)","deg)"),vC=im(Qy,", ",")",")"),tv=1e-12;function Kp(n){return((n=Math.exp(n))+1/n)/2}function ev(n){return((n=Math.exp(n))-1/n)/2}function nv(n){return((n=Math.exp(2*n))-1)/(n+1)}var bC=(function n(t,e,i){function s(r,o){var a=r[0],c=r[1],l=r[2],h=o[0],u=o[1],f=o[2],d=h-a,g=u-c,_=d*d+g*g,p,m;if(_<tv)m=Math.log(f/l)/t,p=function(x){return[a+x*d,c+x*g,l*Math.exp(t*x*m)]};else{var y=Math.sqrt(_),S=(f*f-l*l+i*_)/(2*l*e*y),v=(f*f-l*l-i*_)/(2*f*e*y),A=Math.log(Math.sqrt(S*S+1)-S),E=Math.log(Math.sqrt(v*v+1)-v);m=(E-A)/t,p=function(x){var w=x*m,U=Kp(A),C=l/(e*y)*(U*nv(t*w+A)-ev(A));return[a+C*d,c+C*g,l*U/Kp(t*w+A)]}}return p.duration=Math.abs(m)*1e3*t/Math.SQRT2,p}return s.rho=function(r){var o=Math.max(.001,+r),a=o*o,c=a*a;return n(o,a,c)},s})(Math.SQRT2,2,4);function sm(n){return function(t,e){var i=n((t=Ua(t)).h,(e=Ua(e)).h),s=an(t.s,e.s),r=an(t.l,e.l),o=an(t.opacity,e.opacity);return function(a){return t.h=i(a),t.s=s(a),t.l=r(a),t.opacity=o(a),t+""}}}var MC=sm(Qh),SC=sm(an);function rm(n){return function(t,e){var i=n((t=Oa(t)).h,(e=Oa(e)).h),s=an(t.c,e.c),r=an(t.l,e.l),o=an(t.opacity,e.opacity);return function(a){return t.h=i(a),t.c=s(a),t.l=r(a),t.opacity=o(a),t+""}}}var wC=rm(Qh),EC=rm(an);function om(n){return(function t(e){e=+e;function i(s,r){var o=n((s=Ba(s)).h,(r=Ba(r)).h),a=an(s.s,r.s),c=an(s.l,r.l),l=an(s.opacity,r.opacity);return function(h){return s.h=o(h),s.s=a(h),s.l=c(Math.pow(h,e)),s.opacity=l(h),s+""}}return i.gamma=t,i})(1)}var AC=om(Qh),TC=om(an);function tu(n){return function(){return n}}function eu(n){return+n}var am=[0,1];function Ks(n){return n}function nu(n,t){return(t-=n=+n)?function(e){return(e-n)/t}:tu(isNaN(t)?NaN:.5)}function iv(n,t){var e;return n>t&&(e=n,n=t,t=e),function(i){return Math.max(n,Math.min(t,i))}}function sv(n,t,e){var i=n[0],s=n[1],r=t[0],o=t[1];return s<i?(i=nu(s,i),r=e(o,r)):(i=nu(i,s),r=e(r,o)),function(a){return r(i(a))}}function rv(n,t,e){var i=Math.min(n.length,t.length)-1,s=new Array(i),r=new Array(i),o=-1;for(n[i]<n[0]&&(n=n.slice().reverse(),t=t.slice().reverse());++o<i;)s[o]=nu(n[o],n[o+1]),r[o]=e(t[o],t[o+1]);return function(a){var c=vp(n,a,1,i)-1;return r[c](s[c](a))}}function lm(n,t){return t.domain(n.domain()).range(n.range()).interpolate(n.interpolate()).clamp(n.clamp()).unknown(n.unknown())}function ov(){var n=am,t=am,e=Va,i,s,r,o=Ks,a,c,l;function h(){var f=Math.min(n.length,t.length);return o!==Ks&&(o=iv(n[0],n[f-1])),a=f>2?rv:sv,c=l=null,u}function u(f){return f==null||isNaN(f=+f)?r:(c||(c=a(n.map(i),t,e)))(i(o(f)))}return u.invert=function(f){return o(s((l||(l=a(t,n.map(i),Cn)))(f)))},u.domain=function(f){return arguments.length?(n=Array.from(f,eu),h()):n.slice()},u.range=function(f){return arguments.length?(t=Array.from(f),h()):t.slice()},u.rangeRound=function(f){return t=Array.from(f),e=em,h()},u.clamp=function(f){return arguments.length?(o=f?!0:Ks,h()):o!==Ks},u.interpolate=function(f){return arguments.length?(e=f,h()):e},u.unknown=function(f){return arguments.length?(r=f,u):r},function(f,d){return i=f,s=d,h()}}function iu(){return ov()(Ks,Ks)}function av(n){return Math.abs(n=Math.round(n))>=1e21?n.toLocaleString("en").replace(/,/g,""):n.toString(10)}function Ha(n,t){if(!isFinite(n)||n===0)return null;var e=(n=t?n.toExponential(t-1):n.toExponential()).indexOf("e"),i=n.slice(0,e);return[i.length>1?i[0]+i.slice(2):i,+n.slice(e+1)]}function js(n){return n=Ha(Math.abs(n)),n?n[1]:NaN}function lv(n,t){return function(e,i){for(var s=e.length,r=[],o=0,a=n[0],c=0;s>0&&a>0&&(c+a+1>i&&(a=Math.max(1,i-c)),r.push(e.substring(s-=a,s+a)),!((c+=a+1)>i));)a=n[o=(o+1)%n.length];return r.reverse().join(t)}}function cv(n){return function(t){return t.replace(/[0-9]/g,function(e){return n[+e]})}}var hv=/^(?:(.)?([<>=^]))?([+\-( ])?([$#])?(0)?(\d+)?(,)?(\.\d+)?(~)?([a-z%])?$/i;function eo(n){if(!(t=hv.exec(n)))throw new Error("invalid format: "+n);var t;return new su({fill:t[1],align:t[2],sign:t[3],symbol:t[4],zero:t[5],width:t[6],comma:t[7],precision:t[8]&&t[8].slice(1),trim:t[9],type:t[10]})}eo.prototype=su.prototype;function su(n){this.fill=n.fill===void 0?" ":n.fill+"",this.align=n.align===void 0?">":n.align+"",this.sign=n.sign===void 0?"-":n.sign+"",this.symbol=n.symbol===void 0?"":n.symbol+"",this.zero=!!n.zero,this.width=n.width===void 0?void 0:+n.width,this.comma=!!n.comma,this.precision=n.precision===void 0?void 0:+n.precision,this.trim=!!n.trim,this.type=n.type===void 0?"":n.type+""}su.prototype.toString=function(){return this.fill+this.align+this.sign+this.symbol+(this.zero?"0":"")+(this.width===void 0?"":Math.max(1,this.width|0))+(this.comma?",":"")+(this.precision===void 0?"":"."+Math.max(0,this.precision|0))+(this.trim?"~":"")+this.type};function uv(n){t:for(var t=n.length,e=1,i=-1,s;e<t;++e)switch(n[e]){case".":i=s=e;break;case"0":i===0&&(i=e),s=e;break;default:if(!+n[e])break t;i>0&&(i=0);break}return i>0?n.slice(0,i)+n.slice(s+1):n}var Wa;function fv(n,t){var e=Ha(n,t);if(!e)return Wa=void 0,n.toPrecision(t);var i=e[0],s=e[1],r=s-(Wa=Math.max(-8,Math.min(8,Math.floor(s/3)))*3)+1,o=i.length;return r===o?i:r>o?i+new Array(r-o+1).join("0"):r>0?i.slice(0,r)+"."+i.slice(r):"0."+new Array(1-r).join("0")+Ha(n,Math.max(0,t+r-1))[0]}function cm(n,t){var e=Ha(n,t);if(!e)return n+"";var i=e[0],s=e[1];return s<0?"0."+new Array(-s).join("0")+i:i.length>s+1?i.slice(0,s+1)+"."+i.slice(s+1):i+new Array(s-i.length+2).join("0")}var hm={"%":(n,t)=>(n*100).toFixed(t),b:n=>Math.round(n).toString(2),c:n=>n+"",d:av,e:(n,t)=>n.toExponential(t),f:(n,t)=>n.toFixed(t),g:(n,t)=>n.toPrecision(t),o:n=>Math.round(n).toString(8),p:(n,t)=>cm(n*100,t),r:cm,s:fv,X:n=>Math.round(n).toString(16).toUpperCase(),x:n=>Math.round(n).toString(16)};function um(n){return n}var fm=Array.prototype.map,dm=["y","z","a","f","p","n","\xB5","m","","k","M","G","T","P","E","Z","Y"];function dv(n){var t=n.grouping===void 0||n.thousands===void 0?um:lv(fm.call(n.grouping,Number),n.thousands+""),e=n.currency===void 0?"":n.currency[0]+"",i=n.currency===void 0?"":n.currency[1]+"",s=n.decimal===void 0?".":n.decimal+"",r=n.numerals===void 0?um:cv(fm.call(n.numerals,String)),o=n.percent===void 0?"%":n.percent+"",a=n.minus===void 0?"\u2212":n.minus+"",c=n.nan===void 0?"NaN":n.nan+"";function l(u,f){u=eo(u);var d=u.fill,g=u.align,_=u.sign,p=u.symbol,m=u.zero,y=u.width,S=u.comma,v=u.precision,A=u.trim,E=u.type;E==="n"?(S=!0,E="g"):hm[E]||(v===void 0&&(v=12),A=!0,E="g"),(m||d==="0"&&g==="=")&&(m=!0,d="0",g="=");var x=(f&&f.prefix!==void 0?f.prefix:"")+(p==="$"?e:p==="#"&&/[boxX]/.test(E)?"0"+E.toLowerCase():""),w=(p==="$"?i:/[%p]/.test(E)?o:"")+(f&&f.suffix!==void 0?f.suffix:""),U=hm[E],C=/[defgprs%]/.test(E);v=v===void 0?6:/[gprs]/.test(E)?Math.max(1,Math.min(21,v)):Math.max(0,Math.min(20,v));function L(I){var B=x,R=w,W,q,H;if(E==="c")R=U(I)+R,I="";else{I=+I;var K=I<0||1/I<0;if(I=isNaN(I)?c:U(Math.abs(I),v),A&&(I=uv(I)),K&&+I==0&&_!=="+"&&(K=!1),B=(K?_==="("?_:a:_==="-"||_==="("?"":_)+B,R=(E==="s"&&!isNaN(I)&&Wa!==void 0?dm[8+Wa/3]:"")+R+(K&&_==="("?")":""),C){for(W=-1,q=I.length;++W<q;)if(H=I.charCodeAt(W),48>H||H>57){R=(H===46?s+I.slice(W+1):I.slice(W))+R,I=I.slice(0,W);break}}}S&&!m&&(I=t(I,1/0));var X=B.length+I.length+R.length,Y=X<y?new Array(y-X+1).join(d):"";switch(S&&m&&(I=t(Y+I,Y.length?y-R.length:1/0),Y=""),g){case"<":I=B+I+R+Y;break;case"=":I=B+Y+I+R;break;case"^":I=Y.slice(0,X=Y.length>>1)+B+I+R+Y.slice(X);break;default:I=Y+B+I+R;break}return r(I)}return L.toString=function(){return u+""},L}function h(u,f){var d=Math.max(-8,Math.min(8,Math.floor(js(f)/3)))*3,g=Math.pow(10,-d),_=l((u=eo(u),u.type="f",u),{suffix:dm[8+d/3]});return function(p){return _(g*p)}}return{format:l,formatPrefix:h}}var Ga,ru,ou;pv({thousands:",",grouping:[3],currency:["$",""]});function pv(n){return Ga=dv(n),ru=Ga.format,ou=Ga.formatPrefix,Ga}function pm(n){return Math.max(0,-js(Math.abs(n)))}function mm(n,t){return Math.max(0,Math.max(-8,Math.min(8,Math.floor(js(t)/3)))*3-js(Math.abs(n)))}function gm(n,t){return n=Math.abs(n),t=Math.abs(t)-n,Math.max(0,js(t)-js(n))+1}function au(n,t,e,i){var s=wp(n,t,e),r;switch(i=eo(i??",f"),i.type){case"s":{var o=Math.max(Math.abs(n),Math.abs(t));return i.precision==null&&!isNaN(r=mm(s,o))&&(i.precision=r),ou(i,o)}case"":case"e":case"g":case"p":case"r":{i.precision==null&&!isNaN(r=gm(s,Math.max(Math.abs(n),Math.abs(t))))&&(i.precision=r-(i.type==="e"));break}case"f":case"%":{i.precision==null&&!isNaN(r=pm(s))&&(i.precision=r-(i.type==="%")*2);break}}return ru(i)}function mv(n){var t=n.domain;return n.ticks=function(e){var i=t();return Sp(i[0],i[i.length-1],e??10)},n.tickFormat=function(e,i){var s=t();return au(s[0],s[s.length-1],e??10,i)},n.nice=function(e){e==null&&(e=10);var i=t(),s=0,r=i.length-1,o=i[s],a=i[r],c,l,h=10;for(a<o&&(l=o,o=a,a=l,l=s,s=r,r=l);h-- >0;){if(l=Pa(o,a,e),l===c)return i[s]=o,i[r]=a,t(i);if(l>0)o=Math.floor(o/l)*l,a=Math.ceil(a/l)*l;else if(l<0)o=Math.ceil(o*l)/l,a=Math.floor(a*l)/l;else break;c=l}return n},n}function hi(){var n=iu();return n.copy=function(){return lm(n,hi())},Ep.apply(n,arguments),mv(n)}function ms(n){return function(){return n}}var no=Math.PI,lu=2*no,gs=1e-6,gv=lu-gs;function _m(n){this._+=n[0];for(let t=1,e=n.length;t<e;++t)this._+=arguments[t]+n[t]}function _v(n){let t=Math.floor(n);if(!(t>=0))throw new Error(`invalid digits: ${n}`);if(t>15)return _m;let e=10**t;return function(i){this._+=i[0];for(let s=1,r=i.length;s<r;++s)this._+=Math.round(arguments[s]*e)/e+i[s]}}function xm(n,t,e,i){return n===e&&t===i}function xv(n){let t=Math.floor(n);if(!(t<=15))return xm;let e=10**t,i=function(s){return Math.round(s*e)};return function(s,r,o,a){return i(s)===i(o)&&i(r)===i(a)}}var Qs=class{constructor(t){this._x0=this._y0=this._x1=this._y1=null,this._="",this._append=t==null?_m:_v(t),this._equal=t==null?xm:xv(t)}moveTo(t,e){this._append`M${this._x0=this._x1=+t},${this._y0=this._y1=+e}`}closePath(){this._x1!==null&&(this._x1=this._x0,this._y1=this._y0,this._append`Z`)}lineTo(t,e){this._append`L${this._x1=+t},${this._y1=+e}`}quadraticCurveTo(t,e,i,s){this._append`Q${+t},${+e},${this._x1=+i},${this._y1=+s}`}bezierCurveTo(t,e,i,s,r,o){this._append`C${+t},${+e},${+i},${+s},${this._x1=+r},${this._y1=+o}`}arcTo(t,e,i,s,r){if(t=+t,e=+e,i=+i,s=+s,r=+r,r<0)throw new Error(`negative radius: ${r}`);let o=this._x1,a=this._y1,c=i-t,l=s-e,h=o-t,u=a-e,f=h*h+u*u;if(this._x1===null)this._append`M${this._x1=t},${this._y1=e}`;else if(f>gs)if(!(Math.abs(u*c-l*h)>gs)||!r)this._append`L${this._x1=t},${this._y1=e}`;else{let d=i-o,g=s-a,_=c*c+l*l,p=d*d+g*g,m=Math.sqrt(_),y=Math.sqrt(f),S=r*Math.tan((no-Math.acos((_+f-p)/(2*m*y)))/2),v=S/y,A=S/m;Math.abs(v-1)>gs&&this._append`L${t+v*h},${e+v*u}`,this._append`A${r},${r},0,0,${+(u*d>h*g)},${this._x1=t+A*c},${this._y1=e+A*l}`}}arc(t,e,i,s,r,o){if(t=+t,e=+e,i=+i,o=!!o,i<0)throw new Error(`negative radius: ${i}`);let a=i*Math.cos(s),c=i*Math.sin(s),l=t+a,h=e+c,u=1^o,f=o?s-r:r-s;if(this._x1===null?this._append`M${l},${h}`:(Math.abs(this._x1-l)>gs||Math.abs(this._y1-h)>gs)&&this._append`L${l},${h}`,!!i){if(f<0&&(f=f%lu+lu),f>gv)this._append`A${i},${i},0,1,${u},${t-a},${e-c}A${i},${i},0,1,${u},${this._x1=l},${this._y1=h}`;else if(f>gs){let d=t+i*Math.cos(r),g=e+i*Math.sin(r);if(f>=no&&this._equal(l,h,d,g)){f/=2;let _=s+f;this._append`A${i},${i},0,${+(f>=no)},${u},${t+i*Math.cos(_)},${e+i*Math.sin(_)}`}this._append`A${i},${i},0,${+(f>=no)},${u},${this._x1=d},${this._y1=g}`}}}rect(t,e,i,s){this._append`M${this._x0=this._x1=+t},${this._y0=this._y1=+e}h${i=+i}v${+s}h${-i}Z`}toString(){return this._}};function yv(){return new Qs}yv.prototype=Qs.prototype;function ym(n){let t=3;return n.digits=function(e){if(!arguments.length)return t;if(e==null)t=null;else{let i=Math.floor(e);if(!(i>=0))throw new RangeError(`invalid digits: ${e}`);t=i}return n},()=>new Qs(t)}var KC=Array.prototype.slice;function vm(n){return typeof n=="object"&&"length"in n?n:Array.from(n)}function bm(n){this._context=n}bm.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._point=0},lineEnd:function(){(this._line||this._line!==0&&this._point===1)&&this._context.closePath(),this._line=1-this._line},point:function(n,t){switch(n=+n,t=+t,this._point){case 0:this._point=1,this._line?this._context.lineTo(n,t):this._context.moveTo(n,t);break;case 1:this._point=2;default:this._context.lineTo(n,t);break}}};function Mm(n){return new bm(n)}function Sm(n){return n[0]}function wm(n){return n[1]}function cu(n,t){var e=ms(!0),i=null,s=Mm,r=null,o=ym(a);n=typeof n=="function"?n:n===void 0?Sm:ms(n),t=typeof t=="function"?t:t===void 0?wm:ms(t);function a(c){var l,h=(c=vm(c)).length,u,f=!1,d;for(i==null&&(r=s(d=o())),l=0;l<=h;++l)!(l<h&&e(u=c[l],l,c))===f&&((f=!f)?r.lineStart():r.lineEnd()),f&&r.point(+n(u,l,c),+t(u,l,c));if(d)return r=null,d+""||null}return a.x=function(c){return arguments.length?(n=typeof c=="function"?c:ms(+c),a):n},a.y=function(c){return arguments.length?(t=typeof c=="function"?c:ms(+c),a):t},a.defined=function(c){return arguments.length?(e=typeof c=="function"?c:ms(!!c),a):e},a.curve=function(c){return arguments.length?(s=c,i!=null&&(r=s(i)),a):s},a.context=function(c){return arguments.length?(c==null?i=r=null:r=s(i=c),a):i},a}var _s={left:38,right:10,top:20,bottom:26},io=n=>String(Number(n.toPrecision(6))).replace("-","\u2212");function hu(n,t,e,{xLabel:i,title:s,xUnit:r="",yTicks:o=4,yFormat:a=io}){let c=Ve("g",{class:"axes"});for(let h of e.ticks(o)){let u=e(h);c.append(Ve("path",{class:"grid",d:`M${n.x} ${u}H${n.x+n.width}`})),c.append(Ve("text",{x:n.x-6,y:u+3.5,"text-anchor":"end"},a(h)))}let l=n.y+n.height;if(c.append(Ve("path",{class:"axis",d:`M${n.x} ${l}H${n.x+n.width}`})),i!==void 0){for(let h of t.ticks(Math.max(3,n.width/70))){let u=t(h);c.append(Ve("path",{class:"axis",d:`M${u} ${l}v4`})),c.append(Ve("text",{x:u,y:l+15,"text-anchor":"middle"},io(h)+r))}i&&c.append(Ve("text",{class:"label",x:n.x+n.width,y:l-5,"text-anchor":"end"},i))}return c.append(Ve("text",{class:"title",x:n.x,y:n.y-7},s)),c}function uu(n,t,e){let i=cu().defined(([s,r])=>Number.isFinite(s)&&Number.isFinite(r)).x(([s])=>Math.round(t(s)*10)/10).y(([,s])=>Math.round(e(s)*10)/10);return n.map(({points:s,colour:r,dashes:o,width:a})=>Ve("path",{class:"curve",d:i(s)??"",stroke:r,"stroke-width":a,...o?{"stroke-dasharray":o.map(c=>c*a).join(" ")}:{}}))}function Em(n,t){let e=Ve("svg",{role:"img","aria-label":t});return n.append(e),{root:e,size(){let[i,s]=[Math.max(200,n.clientWidth),Math.max(120,n.clientHeight)];return e.setAttribute("viewBox",`0 0 ${i} ${s}`),{x:_s.left,y:_s.top,width:i-_s.left-_s.right,height:s-_s.top-_s.bottom}}}}function Am(n){let{root:t,size:e}=Em(n,"Angle of reflection against angle of incidence under each law");return{update(i,s,r,o){let a=e(),c=[...i.flatMap(({points:_})=>_.map(([,p])=>p)),...s.map(({reflection:_})=>_)].filter(Number.isFinite),l=Math.min(0,...c),h=hi([0,90],[a.x,a.x+a.width]),u=hi([Math.max(-90,Math.floor(l/15)*15),90],[a.y+a.height,a.y]),f=s.map(({incidence:_,reflection:p,stage:m})=>Ve("circle",{class:`measured ${m==="after_wall"?"early":""}`,cx:h(_).toFixed(1),cy:u(p).toFixed(1),r:2.6})),d=r===null?[]:[Ve("path",{class:"cursor",d:`M${h(r)} ${a.y}V${a.y+a.height}`})],g=r===null?[]:o.map(({colour:_,y:p})=>Ve("circle",{class:"now",cx:h(r).toFixed(1),cy:u(p).toFixed(1),r:3.4,fill:_}));t.replaceChildren(hu(a,h,u,{title:"reflection against incidence",xLabel:"from the wall\u2019s normal",xUnit:"\xB0",yFormat:_=>`${io(_)}\xB0`}),Ve("path",{class:"same",d:`M${h(0)} ${u(0)}L${h(90)} ${u(90)}`}),...f,...uu(i,h,u),...d,...g)}}}function Tm(n,t){let{root:e,size:i}=Em(n,"Energy kept and height of the ball over time under each law"),s=Ve("path",{class:"cursor"}),r={from:0,until:1},o=i(),a=l=>{let h=e.getBoundingClientRect(),u=(l.clientX-h.left)/h.width*(o.x+o.width+_s.right);t(r.from+Math.max(0,Math.min(1,(u-o.x)/o.width))*(r.until-r.from))};return e.addEventListener("pointerdown",l=>{e.setPointerCapture(l.pointerId),a(l)}),e.addEventListener("pointermove",l=>{l.buttons&&a(l)}),{place:l=>{let h=o.x+o.width*(Math.min(l,r.until)-r.from)/(r.until-r.from);s.setAttribute("d",`M${h.toFixed(1)} ${o.y}V${o.y+o.height}`)},update(l,h,u){o=i(),r=u;let f=Math.max(0,...h.flatMap(({points:S})=>S.map(([,v])=>v))),d=f>.001,g={...o,height:d?(o.height-24)*.52:o.height},_=hi([r.from,r.until],[o.x,o.x+o.width]),p=Math.max(1,...l.flatMap(({points:S})=>S.map(([,v])=>v))),m=hi([0,p*1.02],[g.y+g.height,g.y]),y=[hu(g,_,m,{title:"energy kept",yTicks:d?2:4,yFormat:S=>`${io(100*S)} %`,...d?{}:{xLabel:"time, s"}}),...uu(l,_,m)];if(d){let S={...o,y:g.y+g.height+24,height:o.height-g.height-24},v=f>500,A=hi([0,f*1.05],[S.y+S.height,S.y]),E=x=>io(v?x/1e3:x);y.push(hu(S,_,A,{title:`height, ${v?"m":"mm"}`,xLabel:"time, s",yTicks:2,yFormat:E}),...uu(h,_,A))}e.replaceChildren(...y,s)}}}var Cm=[1/1e3,1/300,1/100,1/30,1/10,1/4,1/2,1,2,4],fu=1e4;function Rm(n,t){let e=Zt("play"),i=Zt("time"),s=Zt("speed");i.max=String(fu);for(let h of Cm){let u=document.createElement("option");u.value=String(h),u.textContent=h<1?`1/${Math.round(1/h)} \xD7`:`${h} \xD7`,s.append(u)}let r=null;function o(h){if(!n.state.playing){r=null;return}let{until:u}=t(),f=r===null?0:Math.min((h-r)/1e3,.1);r=h;let d=Math.min(n.state.t+f*n.state.speed,u);n.change({t:d,playing:d<u},"time"),requestAnimationFrame(o)}function a(h){if(h===n.state.playing)return;let{from:u,until:f}=t(),d=h&&n.state.t>=f-1e-9*(f-u)?u:n.state.t;r=null,n.change({playing:h,t:d},"time"),h&&requestAnimationFrame(o)}function c(h){let{from:u,until:f}=t();n.change({t:Math.max(u,Math.min(h,f)),playing:!1},"time")}function l(h){let{events:u,from:f,until:d}=t(),g=n.state.t,_=1e-9*Math.max(d,.001),p=u.map(({t:y})=>y).filter(y=>y>=f&&y<=d),m=h>0?p.find(y=>y>g+_):p.findLast(y=>y<g-_);c(m??(h>0?d:f))}return e.onclick=()=>a(!n.state.playing),Zt("next").onclick=()=>l(1),Zt("previous").onclick=()=>l(-1),Zt("restart").onclick=()=>c(t().from),i.oninput=()=>{let{from:h,until:u}=t();c(h+Number(i.value)/fu*(u-h))},s.onchange=()=>n.change({speed:Number(s.value)},"time"),addEventListener("keydown",h=>{let u=h.target;if(h.ctrlKey||h.metaKey||h.altKey||/^(INPUT|SELECT|TEXTAREA)$/.test(u.tagName))return;let{from:f,until:d}=t(),g=(d-f)/200,_={" ":()=>a(!n.state.playing),ArrowLeft:()=>c(n.state.t-g*(h.shiftKey?10:1)),ArrowRight:()=>c(n.state.t+g*(h.shiftKey?10:1)),",":()=>l(-1),".":()=>l(1),Home:()=>c(f),End:()=>c(d)};h.key===" "&&u.tagName==="BUTTON"||Object.hasOwn(_,h.key)&&(h.preventDefault(),_[h.key]())}),{setPlaying:a,seek:c,update(){let{from:h,until:u,events:f}=t(),{t:d,playing:g}=n.state;i.value=String(Math.round((d-h)/(u-h)*fu)),i.setAttribute("aria-valuetext",Xr(d)),Zt("clock").textContent=`${Xr(d)} of ${Xr(u)}`,e.textContent=g?"Pause":"Play",e.setAttribute("aria-pressed",String(g)),s.value=String(Cm.reduce((m,y)=>Math.abs(Math.log(y/n.state.speed))<Math.abs(Math.log(m/n.state.speed))?y:m));let _=1e-9*Math.max(u,.001),p=f.findLast(m=>m.t<=d+_);Zt("event").textContent=p?`${Xr(p.t)}: ${p.text}`:""}}}var Xa=class{constructor(t){this.state=t,this.listeners=[],this.past=[],this.future=[]}listen(t){this.listeners.push(t)}change(t,...e){Object.assign(this.state,t);let i=new Set(e);for(let s of this.listeners)s(i)}remember(){let t=JSON.stringify(this.state.scene);this.past[this.past.length-1]!==t&&(this.past.push(t),this.past.length>100&&this.past.shift(),this.future=[])}#t(t,e){let i=JSON.stringify(this.state.scene),s=t.pop();for(;s===i;)s=t.pop();if(s===void 0)return;e.push(i);let r=JSON.parse(s),o=Math.min(this.state.ball,r.balls.length-1);this.change({scene:r,ball:o,wall:Math.min(this.state.wall,r.walls.length-1)},"scene","laws")}undo(){this.#t(this.past,this.future)}redo(){this.#t(this.future,this.past)}};var qi={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},Yi={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},cg=0,Wu=1,hg=2;var Bo=1,ug=2,Tr=3,Zi=0,De=1,Sn=2,As=0,Cr=1,Xu=2,$u=3,qu=4,fg=5;var Ts=100,dg=101,pg=102,mg=103,gg=104,_g=200,xg=201,yg=202,vg=203,Yu=204,Zu=205,bg=206,Mg=207,Sg=208,wg=209,Eg=210,Ag=211,Tg=212,Cg=213,Rg=214,vl=0,bl=1,Ml=2,_r=3,Sl=4,wl=5,El=6,Al=7,tc=0,Pg=1,Ig=2,Jn=0,Ju=1,Ku=2,ju=3,Qu=4,tf=5,ef=6,nf=7;var sf=300,Cs=301,Rr=302,ec=303,nc=304,Tl=1e3,Yn=1001,Cl=1002,Ie=1003,Lg=1004;var ko=1005;var Qe=1006,ic=1007;var wi=1008;var ln=1009,rf=1010,of=1011,Pr=1012,sc=1013,Fn=1014,Bn=1015,kn=1016,rc=1017,oc=1018,Rs=1020,af=35902,lf=35899,cf=1021,hf=1022,zn=1023,xi=1026,Ei=1027,uf=1028,ac=1029,Ji=1030,lc=1031;var cc=1033,zo=33776,Vo=33777,Go=33778,Ho=33779,hc=35840,uc=35841,fc=35842,dc=35843,pc=36196,mc=37492,gc=37496,_c=37488,xc=37489,Wo=37490,yc=37491,vc=37808,bc=37809,Mc=37810,Sc=37811,wc=37812,Ec=37813,Ac=37814,Tc=37815,Cc=37816,Rc=37817,Pc=37818,Ic=37819,Lc=37820,Nc=37821,Dc=36492,Uc=36494,Oc=36495,Fc=36283,Bc=36284,Xo=36285,kc=36286;var uo=2300,Rl=2301,xl=2302,Ou=2303,Fu=2400,Bu=2401,ku=2402;var Ng=3200;var zc=0,Dg=1,Ai="",Je="srgb",fo="srgb-linear",po="linear",ee="srgb";var yl=7680;var Ug=519,Og=512,Fg=513,Bg=514,ff=515,kg=516,zg=517,df=518,pf=519,mf=35044;var gf="300 es",bn=2e3,xr=2001;function vv(n){for(let t=n.length-1;t>=0;--t)if(n[t]>=65535)return!0;return!1}function bv(n){return ArrayBuffer.isView(n)&&!(n instanceof DataView)}function mo(n){return document.createElementNS("http://www.w3.org/1999/xhtml",n)}function Vg(){let n=mo("canvas");return n.style.display="block",n}var Pm={},yr=null;function go(...n){let t="THREE."+n.shift();yr?yr("log",t,...n):console.log(t,...n)}function Gg(n){let t=n[0];if(typeof t=="string"&&t.startsWith("TSL:")){let e=n[1];e&&e.isStackTrace?n[0]+=" "+e.getLocation():n[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return n}function It(...n){n=Gg(n);let t="THREE."+n.shift();if(yr)yr("warn",t,...n);else{let e=n[0];e&&e.isStackTrace?console.warn(e.getError(t)):console.warn(t,...n)}}function Dt(...n){n=Gg(n);let t="THREE."+n.shift();if(yr)yr("error",t,...n);else{let e=n[0];e&&e.isStackTrace?console.error(e.getError(t)):console.error(t,...n)}}function co(...n){let t=n.join(" ");t in Pm||(Pm[t]=!0,It(...n))}function Hg(n,t,e){return new Promise(function(i,s){function r(){switch(n.clientWaitSync(t,n.SYNC_FLUSH_COMMANDS_BIT,0)){case n.WAIT_FAILED:s();break;case n.TIMEOUT_EXPIRED:setTimeout(r,e);break;default:i()}}setTimeout(r,e)})}var Wg={[vl]:vl,[Ml]:El,[Sl]:Sl,[_r]:wl,[bl]:bl,[El]:Ml,[Al]:Al,[wl]:_r},Nn=class{addEventListener(t,e){this._listeners===void 0&&(this._listeners={});let i=this._listeners;i[t]===void 0&&(i[t]=[]),i[t].indexOf(e)===-1&&i[t].push(e)}hasEventListener(t,e){let i=this._listeners;return i===void 0?!1:i[t]!==void 0&&i[t].indexOf(e)!==-1}removeEventListener(t,e){let i=this._listeners;if(i===void 0)return;let s=i[t];if(s!==void 0){let r=s.indexOf(e);r!==-1&&s.splice(r,1)}}dispatchEvent(t){let e=this._listeners;if(e===void 0)return;let i=e[t.type];if(i!==void 0){t.target=this;let s=i.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,t);t.target=null}}},He=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],Im=1234567,mr=Math.PI/180,vr=180/Math.PI;function Ki(){let n=Math.random()*4294967295|0,t=Math.random()*4294967295|0,e=Math.random()*4294967295|0,i=Math.random()*4294967295|0;return(He[n&255]+He[n>>8&255]+He[n>>16&255]+He[n>>24&255]+"-"+He[t&255]+He[t>>8&255]+"-"+He[t>>16&15|64]+He[t>>24&255]+"-"+He[e&63|128]+He[e>>8&255]+"-"+He[e>>16&255]+He[e>>24&255]+He[i&255]+He[i>>8&255]+He[i>>16&255]+He[i>>24&255]).toLowerCase()}function Bt(n,t,e){return Math.max(t,Math.min(e,n))}function _f(n,t){return(n%t+t)%t}function Mv(n,t,e,i,s){return i+(n-t)*(s-i)/(e-t)}function Sv(n,t,e){return n!==t?(e-n)/(t-n):0}function ho(n,t,e){return(1-e)*n+e*t}function wv(n,t,e,i){return ho(n,t,1-Math.exp(-e*i))}function Ev(n,t=1){return t-Math.abs(_f(n,t*2)-t)}function Av(n,t,e){return n<=t?0:n>=e?1:(n=(n-t)/(e-t),n*n*(3-2*n))}function Tv(n,t,e){return n<=t?0:n>=e?1:(n=(n-t)/(e-t),n*n*n*(n*(n*6-15)+10))}function Cv(n,t){return n+Math.floor(Math.random()*(t-n+1))}function Rv(n,t){return n+Math.random()*(t-n)}function Pv(n){return n*(.5-Math.random())}function Iv(n){n!==void 0&&(Im=n);let t=Im+=1831565813;return t=Math.imul(t^t>>>15,t|1),t^=t+Math.imul(t^t>>>7,t|61),((t^t>>>14)>>>0)/4294967296}function Lv(n){return n*mr}function Nv(n){return n*vr}function Dv(n){return n>0&&Number.isInteger(n)&&2**Math.round(Math.log2(n))===n}function Uv(n){return Math.pow(2,Math.ceil(Math.log(n)/Math.LN2))}function xf(n){return Math.pow(2,Math.floor(Math.log(n)/Math.LN2))}function Ov(n,t,e,i,s){let r=Math.cos,o=Math.sin,a=r(e/2),c=o(e/2),l=r((t+i)/2),h=o((t+i)/2),u=r((t-i)/2),f=o((t-i)/2),d=r((i-t)/2),g=o((i-t)/2);switch(s){case"XYX":n.set(a*h,c*u,c*f,a*l);break;case"YZY":n.set(c*f,a*h,c*u,a*l);break;case"ZXZ":n.set(c*u,c*f,a*h,a*l);break;case"XZX":n.set(a*h,c*g,c*d,a*l);break;case"YXY":n.set(c*d,a*h,c*g,a*l);break;case"ZYZ":n.set(c*g,c*d,a*h,a*l);break;default:It("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function Vc(n){switch(n.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function yf(n,t){if(t.constructor===Float32Array)return n;let e=Vc(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(n/e,-1)}function vf(n,t){if(t.constructor===Float32Array)return n;let e=Vc(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(n*e)}var $o={DEG2RAD:mr,RAD2DEG:vr,generateUUID:Ki,clamp:Bt,euclideanModulo:_f,mapLinear:Mv,inverseLerp:Sv,lerp:ho,damp:wv,pingpong:Ev,smoothstep:Av,smootherstep:Tv,randInt:Cv,randFloat:Rv,randFloatSpread:Pv,seededRandom:Iv,degToRad:Lv,radToDeg:Nv,isPowerOfTwo:Dv,ceilPowerOfTwo:Uv,floorPowerOfTwo:xf,setQuaternionFromProperEuler:Ov,normalize:vf,denormalize:yf},Rt=class{static{this.prototype.isVector2=!0}constructor(t=0,e=0){this.x=t,this.y=e}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,e){return this.x=t,this.y=e,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;default:throw new Error("THREE.Vector2: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){let e=this.x,i=this.y,s=t.elements;return this.x=s[0]*e+s[3]*i+s[6],this.y=s[1]*e+s[4]*i+s[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,e){return this.x=Bt(this.x,t.x,e.x),this.y=Bt(this.y,t.y,e.y),this}clampScalar(t,e){return this.x=Bt(this.x,t,e),this.y=Bt(this.y,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Bt(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let i=this.dot(t)/e;return Math.acos(Bt(i,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,i=this.y-t.y;return e*e+i*i}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this}rotateAround(t,e){let i=Math.cos(e),s=Math.sin(e),r=this.x-t.x,o=this.y-t.y;return this.x=r*i-o*s+t.x,this.y=r*s+o*i+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},Ne=class{constructor(t=0,e=0,i=0,s=1){this.isQuaternion=!0,this._x=t,this._y=e,this._z=i,this._w=s}static slerpFlat(t,e,i,s,r,o,a){let c=i[s+0],l=i[s+1],h=i[s+2],u=i[s+3],f=r[o+0],d=r[o+1],g=r[o+2],_=r[o+3];if(u!==_||c!==f||l!==d||h!==g){let p=c*f+l*d+h*g+u*_;p<0&&(f=-f,d=-d,g=-g,_=-_,p=-p);let m=1-a;if(p<.9995){let y=Math.acos(p),S=Math.sin(y);m=Math.sin(m*y)/S,a=Math.sin(a*y)/S,c=c*m+f*a,l=l*m+d*a,h=h*m+g*a,u=u*m+_*a}else{c=c*m+f*a,l=l*m+d*a,h=h*m+g*a,u=u*m+_*a;let y=1/Math.sqrt(c*c+l*l+h*h+u*u);c*=y,l*=y,h*=y,u*=y}}t[e]=c,t[e+1]=l,t[e+2]=h,t[e+3]=u}static multiplyQuaternionsFlat(t,e,i,s,r,o){let a=i[s],c=i[s+1],l=i[s+2],h=i[s+3],u=r[o],f=r[o+1],d=r[o+2],g=r[o+3];return t[e]=a*g+h*u+c*d-l*f,t[e+1]=c*g+h*f+l*u-a*d,t[e+2]=l*g+h*d+a*f-c*u,t[e+3]=h*g-a*u-c*f-l*d,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,e,i,s){return this._x=t,this._y=e,this._z=i,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,e=!0){let i=t._x,s=t._y,r=t._z,o=t._order,a=Math.cos,c=Math.sin,l=a(i/2),h=a(s/2),u=a(r/2),f=c(i/2),d=c(s/2),g=c(r/2);switch(o){case"XYZ":this._x=f*h*u+l*d*g,this._y=l*d*u-f*h*g,this._z=l*h*g+f*d*u,this._w=l*h*u-f*d*g;break;case"YXZ":this._x=f*h*u+l*d*g,this._y=l*d*u-f*h*g,this._z=l*h*g-f*d*u,this._w=l*h*u+f*d*g;break;case"ZXY":this._x=f*h*u-l*d*g,this._y=l*d*u+f*h*g,this._z=l*h*g+f*d*u,this._w=l*h*u-f*d*g;break;case"ZYX":this._x=f*h*u-l*d*g,this._y=l*d*u+f*h*g,this._z=l*h*g-f*d*u,this._w=l*h*u+f*d*g;break;case"YZX":this._x=f*h*u+l*d*g,this._y=l*d*u+f*h*g,this._z=l*h*g-f*d*u,this._w=l*h*u-f*d*g;break;case"XZY":this._x=f*h*u-l*d*g,this._y=l*d*u-f*h*g,this._z=l*h*g+f*d*u,this._w=l*h*u+f*d*g;break;default:It("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return e===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,e){let i=e/2,s=Math.sin(i);return this._x=t.x*s,this._y=t.y*s,this._z=t.z*s,this._w=Math.cos(i),this._onChangeCallback(),this}setFromRotationMatrix(t){let e=t.elements,i=e[0],s=e[4],r=e[8],o=e[1],a=e[5],c=e[9],l=e[2],h=e[6],u=e[10],f=i+a+u;if(f>0){let d=.5/Math.sqrt(f+1);this._w=.25/d,this._x=(h-c)*d,this._y=(r-l)*d,this._z=(o-s)*d}else if(i>a&&i>u){let d=2*Math.sqrt(1+i-a-u);this._w=(h-c)/d,this._x=.25*d,this._y=(s+o)/d,this._z=(r+l)/d}else if(a>u){let d=2*Math.sqrt(1+a-i-u);this._w=(r-l)/d,this._x=(s+o)/d,this._y=.25*d,this._z=(c+h)/d}else{let d=2*Math.sqrt(1+u-i-a);this._w=(o-s)/d,this._x=(r+l)/d,this._y=(c+h)/d,this._z=.25*d}return this._onChangeCallback(),this}setFromUnitVectors(t,e){let i=t.dot(e)+1;return i<1e-8?(i=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=i):(this._x=0,this._y=-t.z,this._z=t.y,this._w=i)):(this._x=t.y*e.z-t.z*e.y,this._y=t.z*e.x-t.x*e.z,this._z=t.x*e.y-t.y*e.x,this._w=i),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(Bt(this.dot(t),-1,1)))}rotateTowards(t,e){let i=this.angleTo(t);if(i===0)return this;let s=Math.min(1,e/i);return this.slerp(t,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,e){let i=t._x,s=t._y,r=t._z,o=t._w,a=e._x,c=e._y,l=e._z,h=e._w;return this._x=i*h+o*a+s*l-r*c,this._y=s*h+o*c+r*a-i*l,this._z=r*h+o*l+i*c-s*a,this._w=o*h-i*a-s*c-r*l,this._onChangeCallback(),this}slerp(t,e){let i=t._x,s=t._y,r=t._z,o=t._w,a=this.dot(t);a<0&&(i=-i,s=-s,r=-r,o=-o,a=-a);let c=1-e;if(a<.9995){let l=Math.acos(a),h=Math.sin(l);c=Math.sin(c*l)/h,e=Math.sin(e*l)/h,this._x=this._x*c+i*e,this._y=this._y*c+s*e,this._z=this._z*c+r*e,this._w=this._w*c+o*e,this._onChangeCallback()}else this._x=this._x*c+i*e,this._y=this._y*c+s*e,this._z=this._z*c+r*e,this._w=this._w*c+o*e,this.normalize();return this}slerpQuaternions(t,e,i){return this.copy(t).slerp(e,i)}random(){let t=2*Math.PI*Math.random(),e=2*Math.PI*Math.random(),i=Math.random(),s=Math.sqrt(1-i),r=Math.sqrt(i);return this.set(s*Math.sin(t),s*Math.cos(t),r*Math.sin(e),r*Math.cos(e))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,e=0){return this._x=t[e],this._y=t[e+1],this._z=t[e+2],this._w=t[e+3],this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._w,t}fromBufferAttribute(t,e){return this._x=t.getX(e),this._y=t.getY(e),this._z=t.getZ(e),this._w=t.getW(e),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},N=class{static{this.prototype.isVector3=!0}constructor(t=0,e=0,i=0){this.x=t,this.y=e,this.z=i}set(t,e,i){return i===void 0&&(i=this.z),this.x=t,this.y=e,this.z=i,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;default:throw new Error("THREE.Vector3: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,e){return this.x=t.x*e.x,this.y=t.y*e.y,this.z=t.z*e.z,this}applyEuler(t){return this.applyQuaternion(Lm.setFromEuler(t))}applyAxisAngle(t,e){return this.applyQuaternion(Lm.setFromAxisAngle(t,e))}applyMatrix3(t){let e=this.x,i=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[3]*i+r[6]*s,this.y=r[1]*e+r[4]*i+r[7]*s,this.z=r[2]*e+r[5]*i+r[8]*s,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){let e=this.x,i=this.y,s=this.z,r=t.elements,o=1/(r[3]*e+r[7]*i+r[11]*s+r[15]);return this.x=(r[0]*e+r[4]*i+r[8]*s+r[12])*o,this.y=(r[1]*e+r[5]*i+r[9]*s+r[13])*o,this.z=(r[2]*e+r[6]*i+r[10]*s+r[14])*o,this}applyQuaternion(t){let e=this.x,i=this.y,s=this.z,r=t.x,o=t.y,a=t.z,c=t.w,l=2*(o*s-a*i),h=2*(a*e-r*s),u=2*(r*i-o*e);return this.x=e+c*l+o*u-a*h,this.y=i+c*h+a*l-r*u,this.z=s+c*u+r*h-o*l,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){let e=this.x,i=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[4]*i+r[8]*s,this.y=r[1]*e+r[5]*i+r[9]*s,this.z=r[2]*e+r[6]*i+r[10]*s,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,e){return this.x=Bt(this.x,t.x,e.x),this.y=Bt(this.y,t.y,e.y),this.z=Bt(this.z,t.z,e.z),this}clampScalar(t,e){return this.x=Bt(this.x,t,e),this.y=Bt(this.y,t,e),this.z=Bt(this.z,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Bt(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this.z=t.z+(e.z-t.z)*i,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,e){let i=t.x,s=t.y,r=t.z,o=e.x,a=e.y,c=e.z;return this.x=s*c-r*a,this.y=r*o-i*c,this.z=i*a-s*o,this}projectOnVector(t){let e=t.lengthSq();if(e===0)return this.set(0,0,0);let i=t.dot(this)/e;return this.copy(t).multiplyScalar(i)}projectOnPlane(t){return du.copy(this).projectOnVector(t),this.sub(du)}reflect(t){return this.sub(du.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let i=this.dot(t)/e;return Math.acos(Bt(i,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,i=this.y-t.y,s=this.z-t.z;return e*e+i*i+s*s}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,e,i){let s=Math.sin(e)*t;return this.x=s*Math.sin(i),this.y=Math.cos(e)*t,this.z=s*Math.cos(i),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,e,i){return this.x=t*Math.sin(e),this.y=i,this.z=t*Math.cos(e),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this}setFromMatrixScale(t){let e=this.setFromMatrixColumn(t,0).length(),i=this.setFromMatrixColumn(t,1).length(),s=this.setFromMatrixColumn(t,2).length();return this.x=e,this.y=i,this.z=s,this}setFromMatrixColumn(t,e){return this.fromArray(t.elements,e*4)}setFromMatrix3Column(t,e){return this.fromArray(t.elements,e*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let t=Math.random()*Math.PI*2,e=Math.random()*2-1,i=Math.sqrt(1-e*e);return this.x=i*Math.cos(t),this.y=e,this.z=i*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},du=new N,Lm=new Ne,Ut=class{static{this.prototype.isMatrix3=!0}constructor(t,e,i,s,r,o,a,c,l){this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,e,i,s,r,o,a,c,l)}set(t,e,i,s,r,o,a,c,l){let h=this.elements;return h[0]=t,h[1]=s,h[2]=a,h[3]=e,h[4]=r,h[5]=c,h[6]=i,h[7]=o,h[8]=l,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){let e=this.elements,i=t.elements;return e[0]=i[0],e[1]=i[1],e[2]=i[2],e[3]=i[3],e[4]=i[4],e[5]=i[5],e[6]=i[6],e[7]=i[7],e[8]=i[8],this}extractBasis(t,e,i){return t.setFromMatrix3Column(this,0),e.setFromMatrix3Column(this,1),i.setFromMatrix3Column(this,2),this}setFromMatrix4(t){let e=t.elements;return this.set(e[0],e[4],e[8],e[1],e[5],e[9],e[2],e[6],e[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let i=t.elements,s=e.elements,r=this.elements,o=i[0],a=i[3],c=i[6],l=i[1],h=i[4],u=i[7],f=i[2],d=i[5],g=i[8],_=s[0],p=s[3],m=s[6],y=s[1],S=s[4],v=s[7],A=s[2],E=s[5],x=s[8];return r[0]=o*_+a*y+c*A,r[3]=o*p+a*S+c*E,r[6]=o*m+a*v+c*x,r[1]=l*_+h*y+u*A,r[4]=l*p+h*S+u*E,r[7]=l*m+h*v+u*x,r[2]=f*_+d*y+g*A,r[5]=f*p+d*S+g*E,r[8]=f*m+d*v+g*x,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[3]*=t,e[6]*=t,e[1]*=t,e[4]*=t,e[7]*=t,e[2]*=t,e[5]*=t,e[8]*=t,this}determinant(){let t=this.elements,e=t[0],i=t[1],s=t[2],r=t[3],o=t[4],a=t[5],c=t[6],l=t[7],h=t[8];return e*o*h-e*a*l-i*r*h+i*a*c+s*r*l-s*o*c}invert(){let t=this.elements,e=t[0],i=t[1],s=t[2],r=t[3],o=t[4],a=t[5],c=t[6],l=t[7],h=t[8],u=h*o-a*l,f=a*c-h*r,d=l*r-o*c,g=e*u+i*f+s*d;if(g===0)return this.set(0,0,0,0,0,0,0,0,0);let _=1/g;return t[0]=u*_,t[1]=(s*l-h*i)*_,t[2]=(a*i-s*o)*_,t[3]=f*_,t[4]=(h*e-s*c)*_,t[5]=(s*r-a*e)*_,t[6]=d*_,t[7]=(i*c-l*e)*_,t[8]=(o*e-i*r)*_,this}transpose(){let t,e=this.elements;return t=e[1],e[1]=e[3],e[3]=t,t=e[2],e[2]=e[6],e[6]=t,t=e[5],e[5]=e[7],e[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){let e=this.elements;return t[0]=e[0],t[1]=e[3],t[2]=e[6],t[3]=e[1],t[4]=e[4],t[5]=e[7],t[6]=e[2],t[7]=e[5],t[8]=e[8],this}setUvTransform(t,e,i,s,r,o,a){let c=Math.cos(r),l=Math.sin(r);return this.set(i*c,i*l,-i*(c*o+l*a)+o+t,-s*l,s*c,-s*(-l*o+c*a)+a+e,0,0,1),this}scale(t,e){return co("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(pu.makeScale(t,e)),this}rotate(t){return co("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(pu.makeRotation(-t)),this}translate(t,e){return co("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(pu.makeTranslation(t,e)),this}makeTranslation(t,e){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,e,0,0,1),this}makeRotation(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,-i,0,i,e,0,0,0,1),this}makeScale(t,e){return this.set(t,0,0,0,e,0,0,0,1),this}equals(t){let e=this.elements,i=t.elements;for(let s=0;s<9;s++)if(e[s]!==i[s])return!1;return!0}fromArray(t,e=0){for(let i=0;i<9;i++)this.elements[i]=t[i+e];return this}toArray(t=[],e=0){let i=this.elements;return t[e]=i[0],t[e+1]=i[1],t[e+2]=i[2],t[e+3]=i[3],t[e+4]=i[4],t[e+5]=i[5],t[e+6]=i[6],t[e+7]=i[7],t[e+8]=i[8],t}clone(){return new this.constructor().fromArray(this.elements)}},pu=new Ut,Nm=new Ut().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),Dm=new Ut().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function Fv(){let n={enabled:!0,workingColorSpace:fo,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===ee&&(s.r=_i(s.r),s.g=_i(s.g),s.b=_i(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===ee&&(s.r=gr(s.r),s.g=gr(s.g),s.b=gr(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===Ai?po:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},t=[.64,.33,.3,.6,.15,.06],e=[.2126,.7152,.0722],i=[.3127,.329];return n.define({[fo]:{primaries:t,whitePoint:i,transfer:po,toXYZ:Nm,fromXYZ:Dm,luminanceCoefficients:e,workingColorSpaceConfig:{unpackColorSpace:Je},outputColorSpaceConfig:{drawingBufferColorSpace:Je}},[Je]:{primaries:t,whitePoint:i,transfer:ee,toXYZ:Nm,fromXYZ:Dm,luminanceCoefficients:e,outputColorSpaceConfig:{drawingBufferColorSpace:Je}}}),n}var Yt=Fv();function _i(n){return n<.04045?n*.0773993808:Math.pow(n*.9478672986+.0521327014,2.4)}function gr(n){return n<.0031308?n*12.92:1.055*Math.pow(n,.41666)-.055}var tr,Pl=class{static getDataURL(t,e="image/png"){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let i;if(t instanceof HTMLCanvasElement)i=t;else{tr===void 0&&(tr=mo("canvas")),tr.width=t.width,tr.height=t.height;let s=tr.getContext("2d");t instanceof ImageData?s.putImageData(t,0,0):s.drawImage(t,0,0,t.width,t.height),i=tr}return i.toDataURL(e)}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){let e=mo("canvas");e.width=t.width,e.height=t.height;let i=e.getContext("2d");i.drawImage(t,0,0,t.width,t.height);let s=i.getImageData(0,0,t.width,t.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=_i(r[o]/255)*255;return i.putImageData(s,0,0),e}else if(t.data){let e=t.data.slice(0);for(let i=0;i<e.length;i++)e instanceof Uint8Array||e instanceof Uint8ClampedArray?e[i]=Math.floor(_i(e[i]/255)*255):e[i]=_i(e[i]);return{data:e,width:t.width,height:t.height}}else return It("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}},Bv=0,br=class{constructor(t=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:Bv++}),this.uuid=Ki(),this.data=t,this.dataReady=!0,this.version=0}getSize(t){let e=this.data;return typeof HTMLVideoElement<"u"&&e instanceof HTMLVideoElement?t.set(e.videoWidth,e.videoHeight,0):typeof VideoFrame<"u"&&e instanceof VideoFrame?t.set(e.displayWidth,e.displayHeight,0):e!==null?t.set(e.width||0,e.height||0,e.depth||0):t.set(0,0,0),t}set needsUpdate(t){t===!0&&this.version++}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.images[this.uuid]!==void 0)return t.images[this.uuid];let i={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(mu(s[o].image)):r.push(mu(s[o]))}else r=mu(s);i.url=r}return e||(t.images[this.uuid]=i),i}};function mu(n){return typeof HTMLImageElement<"u"&&n instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&n instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&n instanceof ImageBitmap?Pl.getDataURL(n):n.data?{data:Array.from(n.data),width:n.width,height:n.height,type:n.data.constructor.name}:(It("Texture: Unable to serialize Texture."),{})}var kv=0,gu=new N,tn=class n extends Nn{constructor(t=n.DEFAULT_IMAGE,e=n.DEFAULT_MAPPING,i=Yn,s=Yn,r=Qe,o=wi,a=zn,c=ln,l=n.DEFAULT_ANISOTROPY,h=Ai){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:kv++}),this.uuid=Ki(),this.name="",this.source=new br(t),this.mipmaps=[],this.mapping=e,this.channel=0,this.wrapS=i,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=l,this.format=a,this.internalFormat=null,this.type=c,this.offset=new Rt(0,0),this.repeat=new Rt(1,1),this.center=new Rt(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new Ut,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(t&&t.depth&&t.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(gu).x}get height(){return this.source.getSize(gu).y}get depth(){return this.source.getSize(gu).z}get image(){return this.source.data}set image(t){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.normalized=t.normalized,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.mipmapsAutoUpdate=t.mipmapsAutoUpdate,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.renderTarget=t.renderTarget,this.isRenderTargetTexture=t.isRenderTargetTexture,this.isPMREMTexture=t.isPMREMTexture,this.isArrayTexture=t.isArrayTexture,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}setValues(t){for(let e in t){let i=t[e];if(i===void 0){It(`Texture.setValues(): parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){It(`Texture.setValues(): property '${e}' does not exist.`);continue}s&&i&&s.isVector2&&i.isVector2||s&&i&&s.isVector3&&i.isVector3||s&&i&&s.isMatrix3&&i.isMatrix3?s.copy(i):this[e]=i}}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];let i={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(i.userData=this.userData),e||(t.textures[this.uuid]=i),i}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==sf)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case Tl:t.x=t.x-Math.floor(t.x);break;case Yn:t.x=t.x<0?0:1;break;case Cl:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case Tl:t.y=t.y-Math.floor(t.y);break;case Yn:t.y=t.y<0?0:1;break;case Cl:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}};tn.DEFAULT_IMAGE=null;tn.DEFAULT_MAPPING=sf;tn.DEFAULT_ANISOTROPY=1;var ne=class{static{this.prototype.isVector4=!0}constructor(t=0,e=0,i=0,s=1){this.x=t,this.y=e,this.z=i,this.w=s}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,e,i,s){return this.x=t,this.y=e,this.z=i,this.w=s,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;case 3:this.w=e;break;default:throw new Error("THREE.Vector4: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this.w=t.w+e.w,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this.w+=t.w*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this.w=t.w-e.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){let e=this.x,i=this.y,s=this.z,r=this.w,o=t.elements;return this.x=o[0]*e+o[4]*i+o[8]*s+o[12]*r,this.y=o[1]*e+o[5]*i+o[9]*s+o[13]*r,this.z=o[2]*e+o[6]*i+o[10]*s+o[14]*r,this.w=o[3]*e+o[7]*i+o[11]*s+o[15]*r,this}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this.w/=t.w,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);let e=Math.sqrt(1-t.w*t.w);return e<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/e,this.y=t.y/e,this.z=t.z/e),this}setAxisAngleFromRotationMatrix(t){let e,i,s,r,c=t.elements,l=c[0],h=c[4],u=c[8],f=c[1],d=c[5],g=c[9],_=c[2],p=c[6],m=c[10];if(Math.abs(h-f)<.01&&Math.abs(u-_)<.01&&Math.abs(g-p)<.01){if(Math.abs(h+f)<.1&&Math.abs(u+_)<.1&&Math.abs(g+p)<.1&&Math.abs(l+d+m-3)<.1)return this.set(1,0,0,0),this;e=Math.PI;let S=(l+1)/2,v=(d+1)/2,A=(m+1)/2,E=(h+f)/4,x=(u+_)/4,w=(g+p)/4;return S>v&&S>A?S<.01?(i=0,s=.707106781,r=.707106781):(i=Math.sqrt(S),s=E/i,r=x/i):v>A?v<.01?(i=.707106781,s=0,r=.707106781):(s=Math.sqrt(v),i=E/s,r=w/s):A<.01?(i=.707106781,s=.707106781,r=0):(r=Math.sqrt(A),i=x/r,s=w/r),this.set(i,s,r,e),this}let y=Math.sqrt((p-g)*(p-g)+(u-_)*(u-_)+(f-h)*(f-h));return Math.abs(y)<.001&&(y=1),this.x=(p-g)/y,this.y=(u-_)/y,this.z=(f-h)/y,this.w=Math.acos((l+d+m-1)/2),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this.w=e[15],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,e){return this.x=Bt(this.x,t.x,e.x),this.y=Bt(this.y,t.y,e.y),this.z=Bt(this.z,t.z,e.z),this.w=Bt(this.w,t.w,e.w),this}clampScalar(t,e){return this.x=Bt(this.x,t,e),this.y=Bt(this.y,t,e),this.z=Bt(this.z,t,e),this.w=Bt(this.w,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Bt(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this.w+=(t.w-this.w)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this.z=t.z+(e.z-t.z)*i,this.w=t.w+(e.w-t.w)*i,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this.w=t[e+3],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t[e+3]=this.w,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this.w=t.getW(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},Il=class extends Nn{constructor(t=1,e=1,i={}){super(),i=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:Qe,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},i),this.isRenderTarget=!0,this.width=t,this.height=e,this.depth=i.depth,this.scissor=new ne(0,0,t,e),this.scissorTest=!1,this.viewport=new ne(0,0,t,e),this.textures=[];let s=i.count;for(let r=0;r<s;r++)this.textures[r]=new tn({width:t,height:e,depth:i.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(i),this.depthBuffer=i.depthBuffer,this.stencilBuffer=i.stencilBuffer,this.resolveColorBuffer=i.resolveColorBuffer,this.resolveDepthBuffer=i.resolveDepthBuffer,this.resolveStencilBuffer=i.resolveStencilBuffer,this.storeMultisampledColorBuffer=i.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=i.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=i.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=i.depthTexture,this.samples=i.samples,this.multiview=i.multiview,this.useArrayDepthTexture=i.useArrayDepthTexture}_setTextureOptions(t={}){let e={minFilter:Qe,generateMipmaps:!1,flipY:!1,internalFormat:null};t.mapping!==void 0&&(e.mapping=t.mapping),t.wrapS!==void 0&&(e.wrapS=t.wrapS),t.wrapT!==void 0&&(e.wrapT=t.wrapT),t.wrapR!==void 0&&(e.wrapR=t.wrapR),t.magFilter!==void 0&&(e.magFilter=t.magFilter),t.minFilter!==void 0&&(e.minFilter=t.minFilter),t.format!==void 0&&(e.format=t.format),t.type!==void 0&&(e.type=t.type),t.anisotropy!==void 0&&(e.anisotropy=t.anisotropy),t.colorSpace!==void 0&&(e.colorSpace=t.colorSpace),t.flipY!==void 0&&(e.flipY=t.flipY),t.generateMipmaps!==void 0&&(e.generateMipmaps=t.generateMipmaps),t.mipmapsAutoUpdate!==void 0&&(e.mipmapsAutoUpdate=t.mipmapsAutoUpdate),t.internalFormat!==void 0&&(e.internalFormat=t.internalFormat);for(let i=0;i<this.textures.length;i++)this.textures[i].setValues(e)}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}set depthTexture(t){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),t!==null&&t.renderTarget===null&&(t.renderTarget=this),this._depthTexture=t}get depthTexture(){return this._depthTexture}setSize(t,e,i=1){if(this.width!==t||this.height!==e||this.depth!==i){this.width=t,this.height=e,this.depth=i;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=t,this.textures[s].image.height=e,this.textures[s].image.depth=i,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,t,e),this.scissor.set(0,0,t,e)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let e=0,i=t.textures.length;e<i;e++){this.textures[e]=t.textures[e].clone(),this.textures[e].isRenderTargetTexture=!0,this.textures[e].renderTarget=this;let s=Object.assign({},t.textures[e].image);this.textures[e].source=new br(s)}if(this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveColorBuffer=t.resolveColorBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,this.storeMultisampledColorBuffer=t.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=t.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=t.storeMultisampledStencilBuffer,t.depthTexture!==null)if(t.depthTexture.renderTarget===t){let e=t.depthTexture.clone();e.renderTarget=null,this.depthTexture=e}else this.depthTexture=t.depthTexture;else this.depthTexture=null;return this.samples=t.samples,this.multiview=t.multiview,this.useArrayDepthTexture=t.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},fn=class extends Il{constructor(t=1,e=1,i={}){super(t,e,i),this.isWebGLRenderTarget=!0}},_o=class extends tn{constructor(t=null,e=1,i=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:e,height:i,depth:s},this.magFilter=Ie,this.minFilter=Ie,this.wrapR=Yn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}};var Ll=class extends tn{constructor(t=null,e=1,i=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:e,height:i,depth:s},this.magFilter=Ie,this.minFilter=Ie,this.wrapR=Yn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}};var oe=class n{static{this.prototype.isMatrix4=!0}constructor(t,e,i,s,r,o,a,c,l,h,u,f,d,g,_,p){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,e,i,s,r,o,a,c,l,h,u,f,d,g,_,p)}set(t,e,i,s,r,o,a,c,l,h,u,f,d,g,_,p){let m=this.elements;return m[0]=t,m[4]=e,m[8]=i,m[12]=s,m[1]=r,m[5]=o,m[9]=a,m[13]=c,m[2]=l,m[6]=h,m[10]=u,m[14]=f,m[3]=d,m[7]=g,m[11]=_,m[15]=p,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new n().fromArray(this.elements)}copy(t){let e=this.elements,i=t.elements;return e[0]=i[0],e[1]=i[1],e[2]=i[2],e[3]=i[3],e[4]=i[4],e[5]=i[5],e[6]=i[6],e[7]=i[7],e[8]=i[8],e[9]=i[9],e[10]=i[10],e[11]=i[11],e[12]=i[12],e[13]=i[13],e[14]=i[14],e[15]=i[15],this}copyPosition(t){let e=this.elements,i=t.elements;return e[12]=i[12],e[13]=i[13],e[14]=i[14],this}setFromMatrix3(t){let e=t.elements;return this.set(e[0],e[3],e[6],0,e[1],e[4],e[7],0,e[2],e[5],e[8],0,0,0,0,1),this}extractBasis(t,e,i){return this.determinantAffine()===0?(t.set(1,0,0),e.set(0,1,0),i.set(0,0,1),this):(t.setFromMatrixColumn(this,0),e.setFromMatrixColumn(this,1),i.setFromMatrixColumn(this,2),this)}makeBasis(t,e,i){return this.set(t.x,e.x,i.x,0,t.y,e.y,i.y,0,t.z,e.z,i.z,0,0,0,0,1),this}extractRotation(t){if(t.determinantAffine()===0)return this.identity();let e=this.elements,i=t.elements,s=1/er.setFromMatrixColumn(t,0).length(),r=1/er.setFromMatrixColumn(t,1).length(),o=1/er.setFromMatrixColumn(t,2).length();return e[0]=i[0]*s,e[1]=i[1]*s,e[2]=i[2]*s,e[3]=0,e[4]=i[4]*r,e[5]=i[5]*r,e[6]=i[6]*r,e[7]=0,e[8]=i[8]*o,e[9]=i[9]*o,e[10]=i[10]*o,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromEuler(t){let e=this.elements,i=t.x,s=t.y,r=t.z,o=Math.cos(i),a=Math.sin(i),c=Math.cos(s),l=Math.sin(s),h=Math.cos(r),u=Math.sin(r);if(t.order==="XYZ"){let f=o*h,d=o*u,g=a*h,_=a*u;e[0]=c*h,e[4]=-c*u,e[8]=l,e[1]=d+g*l,e[5]=f-_*l,e[9]=-a*c,e[2]=_-f*l,e[6]=g+d*l,e[10]=o*c}else if(t.order==="YXZ"){let f=c*h,d=c*u,g=l*h,_=l*u;e[0]=f+_*a,e[4]=g*a-d,e[8]=o*l,e[1]=o*u,e[5]=o*h,e[9]=-a,e[2]=d*a-g,e[6]=_+f*a,e[10]=o*c}else if(t.order==="ZXY"){let f=c*h,d=c*u,g=l*h,_=l*u;e[0]=f-_*a,e[4]=-o*u,e[8]=g+d*a,e[1]=d+g*a,e[5]=o*h,e[9]=_-f*a,e[2]=-o*l,e[6]=a,e[10]=o*c}else if(t.order==="ZYX"){let f=o*h,d=o*u,g=a*h,_=a*u;e[0]=c*h,e[4]=g*l-d,e[8]=f*l+_,e[1]=c*u,e[5]=_*l+f,e[9]=d*l-g,e[2]=-l,e[6]=a*c,e[10]=o*c}else if(t.order==="YZX"){let f=o*c,d=o*l,g=a*c,_=a*l;e[0]=c*h,e[4]=_-f*u,e[8]=g*u+d,e[1]=u,e[5]=o*h,e[9]=-a*h,e[2]=-l*h,e[6]=d*u+g,e[10]=f-_*u}else if(t.order==="XZY"){let f=o*c,d=o*l,g=a*c,_=a*l;e[0]=c*h,e[4]=-u,e[8]=l*h,e[1]=f*u+_,e[5]=o*h,e[9]=d*u-g,e[2]=g*u-d,e[6]=a*h,e[10]=_*u+f}return e[3]=0,e[7]=0,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromQuaternion(t){return this.compose(zv,t,Vv)}lookAt(t,e,i){let s=this.elements;return hn.subVectors(t,e),hn.lengthSq()===0&&(hn.z=1),hn.normalize(),Ui.crossVectors(i,hn),Ui.lengthSq()===0&&(Math.abs(i.z)===1?hn.x+=1e-4:hn.z+=1e-4,hn.normalize(),Ui.crossVectors(i,hn)),Ui.normalize(),$a.crossVectors(hn,Ui),s[0]=Ui.x,s[4]=$a.x,s[8]=hn.x,s[1]=Ui.y,s[5]=$a.y,s[9]=hn.y,s[2]=Ui.z,s[6]=$a.z,s[10]=hn.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let i=t.elements,s=e.elements,r=this.elements,o=i[0],a=i[4],c=i[8],l=i[12],h=i[1],u=i[5],f=i[9],d=i[13],g=i[2],_=i[6],p=i[10],m=i[14],y=i[3],S=i[7],v=i[11],A=i[15],E=s[0],x=s[4],w=s[8],U=s[12],C=s[1],L=s[5],I=s[9],B=s[13],R=s[2],W=s[6],q=s[10],H=s[14],K=s[3],X=s[7],Y=s[11],rt=s[15];return r[0]=o*E+a*C+c*R+l*K,r[4]=o*x+a*L+c*W+l*X,r[8]=o*w+a*I+c*q+l*Y,r[12]=o*U+a*B+c*H+l*rt,r[1]=h*E+u*C+f*R+d*K,r[5]=h*x+u*L+f*W+d*X,r[9]=h*w+u*I+f*q+d*Y,r[13]=h*U+u*B+f*H+d*rt,r[2]=g*E+_*C+p*R+m*K,r[6]=g*x+_*L+p*W+m*X,r[10]=g*w+_*I+p*q+m*Y,r[14]=g*U+_*B+p*H+m*rt,r[3]=y*E+S*C+v*R+A*K,r[7]=y*x+S*L+v*W+A*X,r[11]=y*w+S*I+v*q+A*Y,r[15]=y*U+S*B+v*H+A*rt,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[4]*=t,e[8]*=t,e[12]*=t,e[1]*=t,e[5]*=t,e[9]*=t,e[13]*=t,e[2]*=t,e[6]*=t,e[10]*=t,e[14]*=t,e[3]*=t,e[7]*=t,e[11]*=t,e[15]*=t,this}determinant(){let t=this.elements,e=t[0],i=t[4],s=t[8],r=t[12],o=t[1],a=t[5],c=t[9],l=t[13],h=t[2],u=t[6],f=t[10],d=t[14],g=t[3],_=t[7],p=t[11],m=t[15],y=c*d-l*f,S=a*d-l*u,v=a*f-c*u,A=o*d-l*h,E=o*f-c*h,x=o*u-a*h;return e*(_*y-p*S+m*v)-i*(g*y-p*A+m*E)+s*(g*S-_*A+m*x)-r*(g*v-_*E+p*x)}determinantAffine(){let t=this.elements,e=t[0],i=t[4],s=t[8],r=t[1],o=t[5],a=t[9],c=t[2],l=t[6],h=t[10];return e*(o*h-a*l)-i*(r*h-a*c)+s*(r*l-o*c)}transpose(){let t=this.elements,e;return e=t[1],t[1]=t[4],t[4]=e,e=t[2],t[2]=t[8],t[8]=e,e=t[6],t[6]=t[9],t[9]=e,e=t[3],t[3]=t[12],t[12]=e,e=t[7],t[7]=t[13],t[13]=e,e=t[11],t[11]=t[14],t[14]=e,this}setPosition(t,e,i){let s=this.elements;return t.isVector3?(s[12]=t.x,s[13]=t.y,s[14]=t.z):(s[12]=t,s[13]=e,s[14]=i),this}invert(){let t=this.elements,e=t[0],i=t[1],s=t[2],r=t[3],o=t[4],a=t[5],c=t[6],l=t[7],h=t[8],u=t[9],f=t[10],d=t[11],g=t[12],_=t[13],p=t[14],m=t[15],y=e*a-i*o,S=e*c-s*o,v=e*l-r*o,A=i*c-s*a,E=i*l-r*a,x=s*l-r*c,w=h*_-u*g,U=h*p-f*g,C=h*m-d*g,L=u*p-f*_,I=u*m-d*_,B=f*m-d*p,R=y*B-S*I+v*L+A*C-E*U+x*w;if(R===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let W=1/R;return t[0]=(a*B-c*I+l*L)*W,t[1]=(s*I-i*B-r*L)*W,t[2]=(_*x-p*E+m*A)*W,t[3]=(f*E-u*x-d*A)*W,t[4]=(c*C-o*B-l*U)*W,t[5]=(e*B-s*C+r*U)*W,t[6]=(p*v-g*x-m*S)*W,t[7]=(h*x-f*v+d*S)*W,t[8]=(o*I-a*C+l*w)*W,t[9]=(i*C-e*I-r*w)*W,t[10]=(g*E-_*v+m*y)*W,t[11]=(u*v-h*E-d*y)*W,t[12]=(a*U-o*L-c*w)*W,t[13]=(e*L-i*U+s*w)*W,t[14]=(_*S-g*A-p*y)*W,t[15]=(h*A-u*S+f*y)*W,this}scale(t){let e=this.elements,i=t.x,s=t.y,r=t.z;return e[0]*=i,e[4]*=s,e[8]*=r,e[1]*=i,e[5]*=s,e[9]*=r,e[2]*=i,e[6]*=s,e[10]*=r,e[3]*=i,e[7]*=s,e[11]*=r,this}getMaxScaleOnAxis(){let t=this.elements,e=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],i=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],s=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(e,i,s))}makeTranslation(t,e,i){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,e,0,0,1,i,0,0,0,1),this}makeRotationX(t){let e=Math.cos(t),i=Math.sin(t);return this.set(1,0,0,0,0,e,-i,0,0,i,e,0,0,0,0,1),this}makeRotationY(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,0,i,0,0,1,0,0,-i,0,e,0,0,0,0,1),this}makeRotationZ(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,-i,0,0,i,e,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,e){let i=Math.cos(e),s=Math.sin(e),r=1-i,o=t.x,a=t.y,c=t.z,l=r*o,h=r*a;return this.set(l*o+i,l*a-s*c,l*c+s*a,0,l*a+s*c,h*a+i,h*c-s*o,0,l*c-s*a,h*c+s*o,r*c*c+i,0,0,0,0,1),this}makeScale(t,e,i){return this.set(t,0,0,0,0,e,0,0,0,0,i,0,0,0,0,1),this}makeShear(t,e,i,s,r,o){return this.set(1,i,r,0,t,1,o,0,e,s,1,0,0,0,0,1),this}compose(t,e,i){let s=this.elements,r=e._x,o=e._y,a=e._z,c=e._w,l=r+r,h=o+o,u=a+a,f=r*l,d=r*h,g=r*u,_=o*h,p=o*u,m=a*u,y=c*l,S=c*h,v=c*u,A=i.x,E=i.y,x=i.z;return s[0]=(1-(_+m))*A,s[1]=(d+v)*A,s[2]=(g-S)*A,s[3]=0,s[4]=(d-v)*E,s[5]=(1-(f+m))*E,s[6]=(p+y)*E,s[7]=0,s[8]=(g+S)*x,s[9]=(p-y)*x,s[10]=(1-(f+_))*x,s[11]=0,s[12]=t.x,s[13]=t.y,s[14]=t.z,s[15]=1,this}decompose(t,e,i){let s=this.elements;t.x=s[12],t.y=s[13],t.z=s[14];let r=this.determinantAffine();if(r===0)return i.set(1,1,1),e.identity(),this;let o=er.set(s[0],s[1],s[2]).length(),a=er.set(s[4],s[5],s[6]).length(),c=er.set(s[8],s[9],s[10]).length();r<0&&(o=-o),Rn.copy(this);let l=1/o,h=1/a,u=1/c;return Rn.elements[0]*=l,Rn.elements[1]*=l,Rn.elements[2]*=l,Rn.elements[4]*=h,Rn.elements[5]*=h,Rn.elements[6]*=h,Rn.elements[8]*=u,Rn.elements[9]*=u,Rn.elements[10]*=u,e.setFromRotationMatrix(Rn),i.x=o,i.y=a,i.z=c,this}makePerspective(t,e,i,s,r,o,a=bn,c=!1){let l=this.elements,h=2*r/(e-t),u=2*r/(i-s),f=(e+t)/(e-t),d=(i+s)/(i-s),g,_;if(c)g=r/(o-r),_=o*r/(o-r);else if(a===bn)g=-(o+r)/(o-r),_=-2*o*r/(o-r);else if(a===xr)g=-o/(o-r),_=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return l[0]=h,l[4]=0,l[8]=f,l[12]=0,l[1]=0,l[5]=u,l[9]=d,l[13]=0,l[2]=0,l[6]=0,l[10]=g,l[14]=_,l[3]=0,l[7]=0,l[11]=-1,l[15]=0,this}makeOrthographic(t,e,i,s,r,o,a=bn,c=!1){let l=this.elements,h=2/(e-t),u=2/(i-s),f=-(e+t)/(e-t),d=-(i+s)/(i-s),g,_;if(c)g=1/(o-r),_=o/(o-r);else if(a===bn)g=-2/(o-r),_=-(o+r)/(o-r);else if(a===xr)g=-1/(o-r),_=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return l[0]=h,l[4]=0,l[8]=0,l[12]=f,l[1]=0,l[5]=u,l[9]=0,l[13]=d,l[2]=0,l[6]=0,l[10]=g,l[14]=_,l[3]=0,l[7]=0,l[11]=0,l[15]=1,this}equals(t){let e=this.elements,i=t.elements;for(let s=0;s<16;s++)if(e[s]!==i[s])return!1;return!0}fromArray(t,e=0){for(let i=0;i<16;i++)this.elements[i]=t[i+e];return this}toArray(t=[],e=0){let i=this.elements;return t[e]=i[0],t[e+1]=i[1],t[e+2]=i[2],t[e+3]=i[3],t[e+4]=i[4],t[e+5]=i[5],t[e+6]=i[6],t[e+7]=i[7],t[e+8]=i[8],t[e+9]=i[9],t[e+10]=i[10],t[e+11]=i[11],t[e+12]=i[12],t[e+13]=i[13],t[e+14]=i[14],t[e+15]=i[15],t}},er=new N,Rn=new oe,zv=new N(0,0,0),Vv=new N(1,1,1),Ui=new N,$a=new N,hn=new N,Um=new oe,Om=new Ne,yi=class n{constructor(t=0,e=0,i=0,s=n.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=e,this._z=i,this._order=s}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,e,i,s=this._order){return this._x=t,this._y=e,this._z=i,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,e=this._order,i=!0){let s=t.elements,r=s[0],o=s[4],a=s[8],c=s[1],l=s[5],h=s[9],u=s[2],f=s[6],d=s[10];switch(e){case"XYZ":this._y=Math.asin(Bt(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,d),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(f,l),this._z=0);break;case"YXZ":this._x=Math.asin(-Bt(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,d),this._z=Math.atan2(c,l)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(Bt(f,-1,1)),Math.abs(f)<.9999999?(this._y=Math.atan2(-u,d),this._z=Math.atan2(-o,l)):(this._y=0,this._z=Math.atan2(c,r));break;case"ZYX":this._y=Math.asin(-Bt(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(f,d),this._z=Math.atan2(c,r)):(this._x=0,this._z=Math.atan2(-o,l));break;case"YZX":this._z=Math.asin(Bt(c,-1,1)),Math.abs(c)<.9999999?(this._x=Math.atan2(-h,l),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,d));break;case"XZY":this._z=Math.asin(-Bt(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(f,l),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,d),this._y=0);break;default:It("Euler: .setFromRotationMatrix() encountered an unknown order: "+e)}return this._order=e,i===!0&&this._onChangeCallback(),this}setFromQuaternion(t,e,i){return Um.makeRotationFromQuaternion(t),this.setFromRotationMatrix(Um,e,i)}setFromVector3(t,e=this._order){return this.set(t.x,t.y,t.z,e)}reorder(t){return Om.setFromEuler(this),this.setFromQuaternion(Om,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};yi.DEFAULT_ORDER="XYZ";var Mr=class{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}},Gv=0,Fm=new N,nr=new Ne,ui=new oe,qa=new N,so=new N,Hv=new N,Wv=new Ne,Bm=new N(1,0,0),km=new N(0,1,0),zm=new N(0,0,1),Vm={type:"added"},Xv={type:"removed"},ir={type:"childadded",child:null},_u={type:"childremoved",child:null},$e=class n extends Nn{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:Gv++}),this.uuid=Ki(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=n.DEFAULT_UP.clone();let t=new N,e=new yi,i=new Ne,s=new N(1,1,1);function r(){i.setFromEuler(e,!1)}function o(){e.setFromQuaternion(i,void 0,!1)}e._onChange(r),i._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:e},quaternion:{configurable:!0,enumerable:!0,value:i},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new oe},normalMatrix:{value:new Ut}}),this.matrix=new oe,this.matrixWorld=new oe,this.matrixAutoUpdate=n.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=n.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new Mr,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,e){this.quaternion.setFromAxisAngle(t,e)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,e){return nr.setFromAxisAngle(t,e),this.quaternion.multiply(nr),this}rotateOnWorldAxis(t,e){return nr.setFromAxisAngle(t,e),this.quaternion.premultiply(nr),this}rotateX(t){return this.rotateOnAxis(Bm,t)}rotateY(t){return this.rotateOnAxis(km,t)}rotateZ(t){return this.rotateOnAxis(zm,t)}translateOnAxis(t,e){return Fm.copy(t).applyQuaternion(this.quaternion),this.position.add(Fm.multiplyScalar(e)),this}translateX(t){return this.translateOnAxis(Bm,t)}translateY(t){return this.translateOnAxis(km,t)}translateZ(t){return this.translateOnAxis(zm,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(ui.copy(this.matrixWorld).invert())}lookAt(t,e,i){t.isVector3?qa.copy(t):qa.set(t,e,i);let s=this.parent;this.updateWorldMatrix(!0,!1),so.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?ui.lookAt(so,qa,this.up):ui.lookAt(qa,so,this.up),this.quaternion.setFromRotationMatrix(ui),s&&(ui.extractRotation(s.matrixWorld),nr.setFromRotationMatrix(ui),this.quaternion.premultiply(nr.invert()))}add(t){if(arguments.length>1){for(let e=0;e<arguments.length;e++)this.add(arguments[e]);return this}return t===this?(Dt("Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(Vm),ir.child=t,this.dispatchEvent(ir),ir.child=null):Dt("Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let i=0;i<arguments.length;i++)this.remove(arguments[i]);return this}let e=this.children.indexOf(t);return e!==-1&&(t.parent=null,this.children.splice(e,1),t.dispatchEvent(Xv),_u.child=t,this.dispatchEvent(_u),_u.child=null),this}removeFromParent(){let t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),ui.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),ui.multiply(t.parent.matrixWorld)),t.applyMatrix4(ui),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(Vm),ir.child=t,this.dispatchEvent(ir),ir.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,e){if(this[t]===e)return this;for(let i=0,s=this.children.length;i<s;i++){let o=this.children[i].getObjectByProperty(t,e);if(o!==void 0)return o}}getObjectsByProperty(t,e,i=[]){this[t]===e&&i.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(t,e,i);return i}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(so,t,Hv),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(so,Wv,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);let e=this.matrixWorld.elements;return t.set(e[8],e[9],e[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(t){t(this);let e=this.children;for(let i=0,s=e.length;i<s;i++)e[i].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);let e=this.children;for(let i=0,s=e.length;i<s;i++)e[i].traverseVisible(t)}traverseAncestors(t){let e=this.parent;e!==null&&(t(e),e.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let t=this.pivot;if(t!==null){let e=t.x,i=t.y,s=t.z,r=this.matrix.elements;r[12]+=e-r[0]*e-r[4]*i-r[8]*s,r[13]+=i-r[1]*e-r[5]*i-r[9]*s,r[14]+=s-r[2]*e-r[6]*i-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,t=!0);let e=this.children;for(let i=0,s=e.length;i<s;i++)e[i].updateMatrixWorld(t)}updateWorldMatrix(t,e,i=!1){let s=this.parent;if(t===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||i)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,i=!0),e===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,i)}}toJSON(t){let e=t===void 0||typeof t=="string",i={};e&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},i.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(t),s.indirectTexture=this._indirectTexture.toJSON(t),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,c){return a[c.uuid]===void 0&&(a[c.uuid]=c.toJSON(t)),c.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(t.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let c=a.shapes;if(Array.isArray(c))for(let l=0,h=c.length;l<h;l++){let u=c[l];r(t.shapes,u)}else r(t.shapes,c)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(t.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let c=0,l=this.material.length;c<l;c++)a.push(r(t.materials,this.material[c]));s.material=a}else s.material=r(t.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(t).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let c=this.animations[a];s.animations.push(r(t.animations,c))}}if(e){let a=o(t.geometries),c=o(t.materials),l=o(t.textures),h=o(t.images),u=o(t.shapes),f=o(t.skeletons),d=o(t.animations),g=o(t.nodes);a.length>0&&(i.geometries=a),c.length>0&&(i.materials=c),l.length>0&&(i.textures=l),h.length>0&&(i.images=h),u.length>0&&(i.shapes=u),f.length>0&&(i.skeletons=f),d.length>0&&(i.animations=d),g.length>0&&(i.nodes=g)}return i.object=s,i;function o(a){let c=[];for(let l in a){let h=a[l];delete h.metadata,c.push(h)}return c}}clone(t){return new this.constructor().copy(this,t)}copy(t,e=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.pivot=t.pivot!==null?t.pivot.clone():null,this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.static=t.static,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),e===!0)for(let i=0;i<t.children.length;i++){let s=t.children[i];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};$e.DEFAULT_UP=new N(0,1,0);$e.DEFAULT_MATRIX_AUTO_UPDATE=!0;$e.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var Xe=class extends $e{constructor(){super(),this.isGroup=!0,this.type="Group"}},$v={type:"move"},Sr=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Xe,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Xe,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new N,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new N),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Xe,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new N,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new N,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){let e=this._hand;if(e)for(let i of t.hand.values())this._getHandJoint(e,i)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,e,i){let s=null,r=null,o=null,a=this._targetRay,c=this._grip,l=this._hand;if(t&&e.session.visibilityState!=="visible-blurred"){if(l&&t.hand){o=!0;for(let _ of t.hand.values()){let p=e.getJointPose(_,i),m=this._getHandJoint(l,_);p!==null&&(m.matrix.fromArray(p.transform.matrix),m.matrix.decompose(m.position,m.quaternion,m.scale),m.matrixWorldNeedsUpdate=!0,m.jointRadius=p.radius),m.visible=p!==null}let h=l.joints["index-finger-tip"],u=l.joints["thumb-tip"],f=h.position.distanceTo(u.position),d=.02,g=.005;l.inputState.pinching&&f>d+g?(l.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!l.inputState.pinching&&f<=d-g&&(l.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else c!==null&&t.gripSpace&&(r=e.getPose(t.gripSpace,i),r!==null&&(c.matrix.fromArray(r.transform.matrix),c.matrix.decompose(c.position,c.quaternion,c.scale),c.matrixWorldNeedsUpdate=!0,r.linearVelocity?(c.hasLinearVelocity=!0,c.linearVelocity.copy(r.linearVelocity)):c.hasLinearVelocity=!1,r.angularVelocity?(c.hasAngularVelocity=!0,c.angularVelocity.copy(r.angularVelocity)):c.hasAngularVelocity=!1,c.eventsEnabled&&c.dispatchEvent({type:"gripUpdated",data:t,target:this})));a!==null&&(s=e.getPose(t.targetRaySpace,i),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent($v)))}return a!==null&&(a.visible=s!==null),c!==null&&(c.visible=r!==null),l!==null&&(l.visible=o!==null),this}_getHandJoint(t,e){if(t.joints[e.jointName]===void 0){let i=new Xe;i.matrixAutoUpdate=!1,i.visible=!1,t.joints[e.jointName]=i,t.add(i)}return t.joints[e.jointName]}},Xg={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},Oi={h:0,s:0,l:0},Ya={h:0,s:0,l:0};function xu(n,t,e){return e<0&&(e+=1),e>1&&(e-=1),e<1/6?n+(t-n)*6*e:e<1/2?t:e<2/3?n+(t-n)*6*(2/3-e):n}var zt=class{constructor(t,e,i){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,e,i)}set(t,e,i){if(e===void 0&&i===void 0){let s=t;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(t,e,i);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,e=Je){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,Yt.colorSpaceToWorking(this,e),this}setRGB(t,e,i,s=Yt.workingColorSpace){return this.r=t,this.g=e,this.b=i,Yt.colorSpaceToWorking(this,s),this}setHSL(t,e,i,s=Yt.workingColorSpace){if(t=_f(t,1),e=Bt(e,0,1),i=Bt(i,0,1),e===0)this.r=this.g=this.b=i;else{let r=i<=.5?i*(1+e):i+e-i*e,o=2*i-r;this.r=xu(o,r,t+1/3),this.g=xu(o,r,t),this.b=xu(o,r,t-1/3)}return Yt.colorSpaceToWorking(this,s),this}setStyle(t,e=Je){function i(r){r!==void 0&&parseFloat(r)<1&&It("Color: Alpha component of "+t+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(t)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,e);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,e);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,e);break;default:It("Color: Unknown color model "+t)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(t)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,e);if(o===6)return this.setHex(parseInt(r,16),e);It("Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,e);return this}setColorName(t,e=Je){let i=Xg[t.toLowerCase()];return i!==void 0?this.setHex(i,e):It("Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=_i(t.r),this.g=_i(t.g),this.b=_i(t.b),this}copyLinearToSRGB(t){return this.r=gr(t.r),this.g=gr(t.g),this.b=gr(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=Je){return Yt.workingToColorSpace(We.copy(this),t),Math.round(Bt(We.r*255,0,255))*65536+Math.round(Bt(We.g*255,0,255))*256+Math.round(Bt(We.b*255,0,255))}getHexString(t=Je){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,e=Yt.workingColorSpace){Yt.workingToColorSpace(We.copy(this),e);let i=We.r,s=We.g,r=We.b,o=Math.max(i,s,r),a=Math.min(i,s,r),c,l,h=(a+o)/2;if(a===o)c=0,l=0;else{let u=o-a;switch(l=h<=.5?u/(o+a):u/(2-o-a),o){case i:c=(s-r)/u+(s<r?6:0);break;case s:c=(r-i)/u+2;break;case r:c=(i-s)/u+4;break}c/=6}return t.h=c,t.s=l,t.l=h,t}getRGB(t,e=Yt.workingColorSpace){return Yt.workingToColorSpace(We.copy(this),e),t.r=We.r,t.g=We.g,t.b=We.b,t}getStyle(t=Je){Yt.workingToColorSpace(We.copy(this),t);let e=We.r,i=We.g,s=We.b;return t!==Je?`color(${t} ${e.toFixed(3)} ${i.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(e*255)},${Math.round(i*255)},${Math.round(s*255)})`}offsetHSL(t,e,i){return this.getHSL(Oi),this.setHSL(Oi.h+t,Oi.s+e,Oi.l+i)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,e){return this.r=t.r+e.r,this.g=t.g+e.g,this.b=t.b+e.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,e){return this.r+=(t.r-this.r)*e,this.g+=(t.g-this.g)*e,this.b+=(t.b-this.b)*e,this}lerpColors(t,e,i){return this.r=t.r+(e.r-t.r)*i,this.g=t.g+(e.g-t.g)*i,this.b=t.b+(e.b-t.b)*i,this}lerpHSL(t,e){this.getHSL(Oi),t.getHSL(Ya);let i=ho(Oi.h,Ya.h,e),s=ho(Oi.s,Ya.s,e),r=ho(Oi.l,Ya.l,e);return this.setHSL(i,s,r),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){let e=this.r,i=this.g,s=this.b,r=t.elements;return this.r=r[0]*e+r[3]*i+r[6]*s,this.g=r[1]*e+r[4]*i+r[7]*s,this.b=r[2]*e+r[5]*i+r[8]*s,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,e=0){return this.r=t[e],this.g=t[e+1],this.b=t[e+2],this}toArray(t=[],e=0){return t[e]=this.r,t[e+1]=this.g,t[e+2]=this.b,t}fromBufferAttribute(t,e){return this.r=t.getX(e),this.g=t.getY(e),this.b=t.getZ(e),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},We=new zt;zt.NAMES=Xg;var xo=class extends $e{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new yi,this.environmentIntensity=1,this.environmentRotation=new yi,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,e){return super.copy(t,e),this.background=t.background!==null?t.background.clone():null,this.environment=t.environment!==null?t.environment.clone():null,this.fog=t.fog!==null?t.fog.clone():null,this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),this.overrideMaterial=t.overrideMaterial!==null?t.overrideMaterial.clone():null,this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){let e=super.toJSON(t);return this.fog!==null&&(e.object.fog=this.fog.toJSON()),e.object.backgroundBlurriness=this.backgroundBlurriness,e.object.backgroundIntensity=this.backgroundIntensity,e.object.backgroundRotation=this.backgroundRotation.toArray(),e.object.environmentIntensity=this.environmentIntensity,e.object.environmentRotation=this.environmentRotation.toArray(),e}},Pn=new N,fi=new N,yu=new N,di=new N,sr=new N,rr=new N,Gm=new N,vu=new N,bu=new N,Mu=new N,Su=new ne,wu=new ne,Eu=new ne,gi=class n{constructor(t=new N,e=new N,i=new N){this.a=t,this.b=e,this.c=i}static getNormal(t,e,i,s){s.subVectors(i,e),Pn.subVectors(t,e),s.cross(Pn);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(t,e,i,s,r){Pn.subVectors(s,e),fi.subVectors(i,e),yu.subVectors(t,e);let o=Pn.dot(Pn),a=Pn.dot(fi),c=Pn.dot(yu),l=fi.dot(fi),h=fi.dot(yu),u=o*l-a*a;if(u===0)return r.set(0,0,0),null;let f=1/u,d=(l*c-a*h)*f,g=(o*h-a*c)*f;return r.set(1-d-g,g,d)}static containsPoint(t,e,i,s){return this.getBarycoord(t,e,i,s,di)===null?!1:di.x>=0&&di.y>=0&&di.x+di.y<=1}static getInterpolation(t,e,i,s,r,o,a,c){return this.getBarycoord(t,e,i,s,di)===null?(c.x=0,c.y=0,"z"in c&&(c.z=0),"w"in c&&(c.w=0),null):(c.setScalar(0),c.addScaledVector(r,di.x),c.addScaledVector(o,di.y),c.addScaledVector(a,di.z),c)}static getInterpolatedAttribute(t,e,i,s,r,o){return Su.setScalar(0),wu.setScalar(0),Eu.setScalar(0),Su.fromBufferAttribute(t,e),wu.fromBufferAttribute(t,i),Eu.fromBufferAttribute(t,s),o.setScalar(0),o.addScaledVector(Su,r.x),o.addScaledVector(wu,r.y),o.addScaledVector(Eu,r.z),o}static isFrontFacing(t,e,i,s){return Pn.subVectors(i,e),fi.subVectors(t,e),Pn.cross(fi).dot(s)<0}set(t,e,i){return this.a.copy(t),this.b.copy(e),this.c.copy(i),this}setFromPointsAndIndices(t,e,i,s){return this.a.copy(t[e]),this.b.copy(t[i]),this.c.copy(t[s]),this}setFromAttributeAndIndices(t,e,i,s){return this.a.fromBufferAttribute(t,e),this.b.fromBufferAttribute(t,i),this.c.fromBufferAttribute(t,s),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return Pn.subVectors(this.c,this.b),fi.subVectors(this.a,this.b),Pn.cross(fi).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return n.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,e){return n.getBarycoord(t,this.a,this.b,this.c,e)}getInterpolation(t,e,i,s,r){return n.getInterpolation(t,this.a,this.b,this.c,e,i,s,r)}containsPoint(t){return n.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return n.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,e){let i=this.a,s=this.b,r=this.c,o,a;sr.subVectors(s,i),rr.subVectors(r,i),vu.subVectors(t,i);let c=sr.dot(vu),l=rr.dot(vu);if(c<=0&&l<=0)return e.copy(i);bu.subVectors(t,s);let h=sr.dot(bu),u=rr.dot(bu);if(h>=0&&u<=h)return e.copy(s);let f=c*u-h*l;if(f<=0&&c>=0&&h<=0&&c-h>0)return o=c/(c-h),e.copy(i).addScaledVector(sr,o);Mu.subVectors(t,r);let d=sr.dot(Mu),g=rr.dot(Mu);if(g>=0&&d<=g)return e.copy(r);let _=d*l-c*g;if(_<=0&&l>=0&&g<=0)return a=l/(l-g),e.copy(i).addScaledVector(rr,a);let p=h*g-d*u;if(p<=0&&u-h>=0&&d-g>=0)return Gm.subVectors(r,s),a=(u-h)/(u-h+(d-g)),e.copy(s).addScaledVector(Gm,a);let m=1/(p+_+f);return o=_*m,a=f*m,e.copy(i).addScaledVector(sr,o).addScaledVector(rr,a)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}},dn=class{constructor(t=new N(1/0,1/0,1/0),e=new N(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=e}set(t,e){return this.min.copy(t),this.max.copy(e),this}setFromArray(t){this.makeEmpty();for(let e=0,i=t.length;e<i;e+=3)this.expandByPoint(In.fromArray(t,e));return this}setFromBufferAttribute(t){this.makeEmpty();for(let e=0,i=t.count;e<i;e++)this.expandByPoint(In.fromBufferAttribute(t,e));return this}setFromPoints(t){this.makeEmpty();for(let e=0,i=t.length;e<i;e++)this.expandByPoint(t[e]);return this}setFromCenterAndSize(t,e){let i=In.copy(e).multiplyScalar(.5);return this.min.copy(t).sub(i),this.max.copy(t).add(i),this}setFromObject(t,e=!1){return this.makeEmpty(),this.expandByObject(t,e)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,e=!1){t.updateWorldMatrix(!1,!1);let i=t.geometry;if(i!==void 0){let r=i.getAttribute("position");if(e===!0&&r!==void 0&&t.isInstancedMesh!==!0&&t.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)t.isMesh===!0?t.getVertexPosition(o,In):In.fromBufferAttribute(r,o),In.applyMatrix4(t.matrixWorld),this.expandByPoint(In);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),Za.copy(t.boundingBox)):(i.boundingBox===null&&i.computeBoundingBox(),Za.copy(i.boundingBox)),Za.applyMatrix4(t.matrixWorld),this.union(Za)}let s=t.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],e);return this}containsPoint(t){return t.x>=this.min.x&&t.x<=this.max.x&&t.y>=this.min.y&&t.y<=this.max.y&&t.z>=this.min.z&&t.z<=this.max.z}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,e){return e.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return t.max.x>=this.min.x&&t.min.x<=this.max.x&&t.max.y>=this.min.y&&t.min.y<=this.max.y&&t.max.z>=this.min.z&&t.min.z<=this.max.z}intersectsSphere(t){return this.clampPoint(t.center,In),In.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let e,i;return t.normal.x>0?(e=t.normal.x*this.min.x,i=t.normal.x*this.max.x):(e=t.normal.x*this.max.x,i=t.normal.x*this.min.x),t.normal.y>0?(e+=t.normal.y*this.min.y,i+=t.normal.y*this.max.y):(e+=t.normal.y*this.max.y,i+=t.normal.y*this.min.y),t.normal.z>0?(e+=t.normal.z*this.min.z,i+=t.normal.z*this.max.z):(e+=t.normal.z*this.max.z,i+=t.normal.z*this.min.z),e<=-t.constant&&i>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(ro),Ja.subVectors(this.max,ro),or.subVectors(t.a,ro),ar.subVectors(t.b,ro),lr.subVectors(t.c,ro),Fi.subVectors(ar,or),Bi.subVectors(lr,ar),xs.subVectors(or,lr);let e=[0,-Fi.z,Fi.y,0,-Bi.z,Bi.y,0,-xs.z,xs.y,Fi.z,0,-Fi.x,Bi.z,0,-Bi.x,xs.z,0,-xs.x,-Fi.y,Fi.x,0,-Bi.y,Bi.x,0,-xs.y,xs.x,0];return!Au(e,or,ar,lr,Ja)||(e=[1,0,0,0,1,0,0,0,1],!Au(e,or,ar,lr,Ja))?!1:(Ka.crossVectors(Fi,Bi),e=[Ka.x,Ka.y,Ka.z],Au(e,or,ar,lr,Ja))}clampPoint(t,e){return e.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,In).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(In).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(pi[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),pi[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),pi[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),pi[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),pi[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),pi[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),pi[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),pi[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(pi),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(t){return this.min.fromArray(t.min),this.max.fromArray(t.max),this}},pi=[new N,new N,new N,new N,new N,new N,new N,new N],In=new N,Za=new dn,or=new N,ar=new N,lr=new N,Fi=new N,Bi=new N,xs=new N,ro=new N,Ja=new N,Ka=new N,ys=new N;function Au(n,t,e,i,s){for(let r=0,o=n.length-3;r<=o;r+=3){ys.fromArray(n,r);let a=s.x*Math.abs(ys.x)+s.y*Math.abs(ys.y)+s.z*Math.abs(ys.z),c=t.dot(ys),l=e.dot(ys),h=i.dot(ys);if(Math.max(-Math.max(c,l,h),Math.min(c,l,h))>a)return!1}return!0}var ye=new N,ja=new Rt,qv=0,Ln=class extends Nn{constructor(t,e,i=!1){if(super(),Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:qv++}),this.name="",this.array=t,this.itemSize=e,this.count=t!==void 0?t.length/e:0,this.normalized=i,this.usage=mf,this.updateRanges=[],this.gpuType=Bn,this.version=0,this._normalizationScale=t!==void 0?Vc(t):void 0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this._normalizationScale=t._normalizationScale,this}copyAt(t,e,i){t*=this.itemSize,i*=e.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[t+s]=e.array[i+s];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let e=0,i=this.count;e<i;e++)ja.fromBufferAttribute(this,e),ja.applyMatrix3(t),this.setXY(e,ja.x,ja.y);else if(this.itemSize===3)for(let e=0,i=this.count;e<i;e++)ye.fromBufferAttribute(this,e),ye.applyMatrix3(t),this.setXYZ(e,ye.x,ye.y,ye.z);return this}applyMatrix4(t){for(let e=0,i=this.count;e<i;e++)ye.fromBufferAttribute(this,e),ye.applyMatrix4(t),this.setXYZ(e,ye.x,ye.y,ye.z);return this}applyNormalMatrix(t){for(let e=0,i=this.count;e<i;e++)ye.fromBufferAttribute(this,e),ye.applyNormalMatrix(t),this.setXYZ(e,ye.x,ye.y,ye.z);return this}transformDirection(t){for(let e=0,i=this.count;e<i;e++)ye.fromBufferAttribute(this,e),ye.transformDirection(t),this.setXYZ(e,ye.x,ye.y,ye.z);return this}set(t,e=0){return this.array.set(t,e),this}getComponent(t,e){let i=this.array[t*this.itemSize+e];return this.normalized&&(i=this._denormalize(i)),i}setComponent(t,e,i){return this.normalized&&(i=this._normalize(i)),this.array[t*this.itemSize+e]=i,this}getX(t){let e=this.array[t*this.itemSize];return this.normalized&&(e=this._denormalize(e)),e}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize]=e,this}getY(t){let e=this.array[t*this.itemSize+1];return this.normalized&&(e=this._denormalize(e)),e}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+1]=e,this}getZ(t){let e=this.array[t*this.itemSize+2];return this.normalized&&(e=this._denormalize(e)),e}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+2]=e,this}getW(t){let e=this.array[t*this.itemSize+3];return this.normalized&&(e=this._denormalize(e)),e}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+3]=e,this}setXY(t,e,i){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i)),this.array[t+0]=e,this.array[t+1]=i,this}setXYZ(t,e,i,s){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i),s=this._normalize(s)),this.array[t+0]=e,this.array[t+1]=i,this.array[t+2]=s,this}setXYZW(t,e,i,s,r){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i),s=this._normalize(s),r=this._normalize(r)),this.array[t+0]=e,this.array[t+1]=i,this.array[t+2]=s,this.array[t+3]=r,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return t.name=this.name,t.usage=this.usage,t.gpuType=this.gpuType,t}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):yf(t,this.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):vf(t,this.array)}};var yo=class extends Ln{constructor(t,e,i){super(new Uint16Array(t),e,i)}};var vo=class extends Ln{constructor(t,e,i){super(new Uint32Array(t),e,i)}};var Xt=class extends Ln{constructor(t,e,i){super(new Float32Array(t),e,i)}},Yv=new dn,oo=new N,Tu=new N,Dn=class{constructor(t=new N,e=-1){this.isSphere=!0,this.center=t,this.radius=e}set(t,e){return this.center.copy(t),this.radius=e,this}setFromPoints(t,e){let i=this.center;e!==void 0?i.copy(e):Yv.setFromPoints(t).getCenter(i);let s=0;for(let r=0,o=t.length;r<o;r++)s=Math.max(s,i.distanceToSquared(t[r]));return this.radius=Math.sqrt(s),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){let e=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=e*e}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,e){let i=this.center.distanceToSquared(t);return e.copy(t),i>this.radius*this.radius&&(e.sub(this.center).normalize(),e.multiplyScalar(this.radius).add(this.center)),e}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;oo.subVectors(t,this.center);let e=oo.lengthSq();if(e>this.radius*this.radius){let i=Math.sqrt(e),s=(i-this.radius)*.5;this.center.addScaledVector(oo,s/i),this.radius+=s}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(Tu.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint(oo.copy(t.center).add(Tu)),this.expandByPoint(oo.copy(t.center).sub(Tu))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(t){return this.radius=t.radius,this.center.fromArray(t.center),this}},Zv=0,vn=new oe,Cu=new $e,cr=new N,un=new dn,ao=new dn,Pe=new N,ue=class n extends Nn{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:Zv++}),this.uuid=Ki(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new(vv(t)?vo:yo)(t,1):this.index=t,this}setIndirect(t,e=0){return this.indirect=t,this.indirectOffset=e,this}getIndirect(){return this.indirect}getAttribute(t){return this.attributes[t]}setAttribute(t,e){return this.attributes[t]=e,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,e,i=0){this.groups.push({start:t,count:e,materialIndex:i})}clearGroups(){this.groups=[]}setDrawRange(t,e){this.drawRange.start=t,this.drawRange.count=e}applyMatrix4(t){let e=this.attributes.position;e!==void 0&&(e.applyMatrix4(t),e.needsUpdate=!0);let i=this.attributes.normal;if(i!==void 0){let r=new Ut().getNormalMatrix(t);i.applyNormalMatrix(r),i.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(t),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(t){return vn.makeRotationFromQuaternion(t),this.applyMatrix4(vn),this}rotateX(t){return vn.makeRotationX(t),this.applyMatrix4(vn),this}rotateY(t){return vn.makeRotationY(t),this.applyMatrix4(vn),this}rotateZ(t){return vn.makeRotationZ(t),this.applyMatrix4(vn),this}translate(t,e,i){return vn.makeTranslation(t,e,i),this.applyMatrix4(vn),this}scale(t,e,i){return vn.makeScale(t,e,i),this.applyMatrix4(vn),this}lookAt(t){return Cu.lookAt(t),Cu.updateMatrix(),this.applyMatrix4(Cu.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(cr).negate(),this.translate(cr.x,cr.y,cr.z),this}setFromPoints(t){let e=this.getAttribute("position");if(e===void 0){let i=[];for(let s=0,r=t.length;s<r;s++){let o=t[s];i.push(o.x,o.y,o.z||0)}this.setAttribute("position",new Xt(i,3))}else{let i=Math.min(t.length,e.count);for(let s=0;s<i;s++){let r=t[s];e.setXYZ(s,r.x,r.y,r.z||0)}t.length>e.count&&It("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),e.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new dn);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Dt("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new N(-1/0,-1/0,-1/0),new N(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),e)for(let i=0,s=e.length;i<s;i++){let r=e[i];un.setFromBufferAttribute(r),this.morphTargetsRelative?(Pe.addVectors(this.boundingBox.min,un.min),this.boundingBox.expandByPoint(Pe),Pe.addVectors(this.boundingBox.max,un.max),this.boundingBox.expandByPoint(Pe)):(this.boundingBox.expandByPoint(un.min),this.boundingBox.expandByPoint(un.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&Dt('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Dn);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Dt("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new N,1/0);return}if(t){let i=this.boundingSphere.center;if(un.setFromBufferAttribute(t),e)for(let r=0,o=e.length;r<o;r++){let a=e[r];ao.setFromBufferAttribute(a),this.morphTargetsRelative?(Pe.addVectors(un.min,ao.min),un.expandByPoint(Pe),Pe.addVectors(un.max,ao.max),un.expandByPoint(Pe)):(un.expandByPoint(ao.min),un.expandByPoint(ao.max))}un.getCenter(i);let s=0;for(let r=0,o=t.count;r<o;r++)Pe.fromBufferAttribute(t,r),s=Math.max(s,i.distanceToSquared(Pe));if(e)for(let r=0,o=e.length;r<o;r++){let a=e[r],c=this.morphTargetsRelative;for(let l=0,h=a.count;l<h;l++)Pe.fromBufferAttribute(a,l),c&&(cr.fromBufferAttribute(t,l),Pe.add(cr)),s=Math.max(s,i.distanceToSquared(Pe))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&Dt('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let t=this.index,e=this.attributes;if(t===null||e.position===void 0||e.normal===void 0||e.uv===void 0){Dt("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let i=e.position,s=e.normal,r=e.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==i.count)&&(o=new Ln(new Float32Array(4*i.count),4),this.setAttribute("tangent",o));let a=[],c=[],l=new Uint8Array(i.count);for(let U=0;U<i.count;U++)a[U]=new N,c[U]=new N;let h=new N,u=new N,f=new N,d=new Rt,g=new Rt,_=new Rt,p=new N,m=new N;function y(U,C,L){l[U]=l[C]=l[L]=1,h.fromBufferAttribute(i,U),u.fromBufferAttribute(i,C),f.fromBufferAttribute(i,L),d.fromBufferAttribute(r,U),g.fromBufferAttribute(r,C),_.fromBufferAttribute(r,L),u.sub(h),f.sub(h),g.sub(d),_.sub(d);let I=1/(g.x*_.y-_.x*g.y);isFinite(I)&&(p.copy(u).multiplyScalar(_.y).addScaledVector(f,-g.y).multiplyScalar(I),m.copy(f).multiplyScalar(g.x).addScaledVector(u,-_.x).multiplyScalar(I),a[U].add(p),a[C].add(p),a[L].add(p),c[U].add(m),c[C].add(m),c[L].add(m))}let S=this.groups;S.length===0&&(S=[{start:0,count:t.count}]);for(let U=0,C=S.length;U<C;++U){let L=S[U],I=L.start,B=L.count;for(let R=I,W=I+B;R<W;R+=3)y(t.getX(R+0),t.getX(R+1),t.getX(R+2))}let v=new N,A=new N,E=new N,x=new N;function w(U){E.fromBufferAttribute(s,U),x.copy(E);let C=a[U];v.copy(C),v.sub(E.multiplyScalar(E.dot(C))).normalize(),A.crossVectors(x,C);let I=A.dot(c[U])<0?-1:1;o.setXYZW(U,v.x,v.y,v.z,I)}for(let U=0,C=i.count;U<C;++U)l[U]&&w(U);this._transformed=!0}computeVertexNormals(){let t=this.index,e=this.getAttribute("position");if(e!==void 0){let i=this.getAttribute("normal");if(i===void 0||i.count!==e.count)i=new Ln(new Float32Array(e.count*3),3),this.setAttribute("normal",i);else for(let f=0,d=i.count;f<d;f++)i.setXYZ(f,0,0,0);let s=new N,r=new N,o=new N,a=new N,c=new N,l=new N,h=new N,u=new N;if(t)for(let f=0,d=t.count;f<d;f+=3){let g=t.getX(f+0),_=t.getX(f+1),p=t.getX(f+2);s.fromBufferAttribute(e,g),r.fromBufferAttribute(e,_),o.fromBufferAttribute(e,p),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),a.fromBufferAttribute(i,g),c.fromBufferAttribute(i,_),l.fromBufferAttribute(i,p),a.add(h),c.add(h),l.add(h),i.setXYZ(g,a.x,a.y,a.z),i.setXYZ(_,c.x,c.y,c.z),i.setXYZ(p,l.x,l.y,l.z)}else for(let f=0,d=e.count;f<d;f+=3)s.fromBufferAttribute(e,f+0),r.fromBufferAttribute(e,f+1),o.fromBufferAttribute(e,f+2),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),i.setXYZ(f+0,h.x,h.y,h.z),i.setXYZ(f+1,h.x,h.y,h.z),i.setXYZ(f+2,h.x,h.y,h.z);this.normalizeNormals(),i.needsUpdate=!0}}normalizeNormals(){let t=this.attributes.normal;for(let e=0,i=t.count;e<i;e++)Pe.fromBufferAttribute(t,e),Pe.normalize(),t.setXYZ(e,Pe.x,Pe.y,Pe.z)}toNonIndexed(){function t(a,c){let l=a.array,h=a.itemSize,u=a.normalized,f=new l.constructor(c.length*h),d=0,g=0;for(let _=0,p=c.length;_<p;_++){a.isInterleavedBufferAttribute?d=c[_]*a.data.stride+a.offset:d=c[_]*h;for(let m=0;m<h;m++)f[g++]=l[d++]}return new Ln(f,h,u)}if(this.index===null)return It("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let e=new n,i=this.index.array,s=this.attributes;for(let a in s){let c=s[a],l=t(c,i);e.setAttribute(a,l)}let r=this.morphAttributes;for(let a in r){let c=[],l=r[a];for(let h=0,u=l.length;h<u;h++){let f=l[h],d=t(f,i);c.push(d)}e.morphAttributes[a]=c}e.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,c=o.length;a<c;a++){let l=o[a];e.addGroup(l.start,l.count,l.materialIndex)}return e}toJSON(){let t={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,t.name=this.name,Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let c=this.parameters;for(let l in c)c[l]!==void 0&&(t[l]=c[l]);return t}t.data={attributes:{}};let e=this.index;e!==null&&(t.data.index={type:e.array.constructor.name,array:Array.prototype.slice.call(e.array)});let i=this.attributes;for(let c in i){let l=i[c];t.data.attributes[c]=l.toJSON(t.data)}let s={},r=!1;for(let c in this.morphAttributes){let l=this.morphAttributes[c],h=[];for(let u=0,f=l.length;u<f;u++){let d=l[u];h.push(d.toJSON(t.data))}h.length>0&&(s[c]=h,r=!0)}r&&(t.data.morphAttributes=s,t.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(t.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(t.data.boundingSphere=a.toJSON()),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let e={};this.name=t.name;let i=t.index;i!==null&&this.setIndex(i.clone());let s=t.attributes;for(let l in s){let h=s[l];this.setAttribute(l,h.clone(e))}let r=t.morphAttributes;for(let l in r){let h=[],u=r[l];for(let f=0,d=u.length;f<d;f++)h.push(u[f].clone(e));this.morphAttributes[l]=h}this.morphTargetsRelative=t.morphTargetsRelative;let o=t.groups;for(let l=0,h=o.length;l<h;l++){let u=o[l];this.addGroup(u.start,u.count,u.materialIndex)}let a=t.boundingBox;a!==null&&(this.boundingBox=a.clone());let c=t.boundingSphere;return c!==null&&(this.boundingSphere=c.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this._transformed=t._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}},Nl=class{constructor(t,e){this.isInterleavedBuffer=!0,this.array=t,this.stride=e,this.count=t!==void 0?t.length/e:0,this.usage=mf,this.updateRanges=[],this.version=0,this.uuid=Ki()}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.array=new t.array.constructor(t.array),this.count=t.count,this.stride=t.stride,this.usage=t.usage,this}copyAt(t,e,i){t*=this.stride,i*=e.stride;for(let s=0,r=this.stride;s<r;s++)this.array[t+s]=e.array[i+s];return this}set(t,e=0){return this.array.set(t,e),this}clone(t){t.arrayBuffers===void 0&&(t.arrayBuffers={});let e=Hm(this.array);t.arrayBuffers[e]===void 0&&(t.arrayBuffers[e]=this.array.slice(0).buffer);let i=new this.array.constructor(t.arrayBuffers[e]),s=new this.constructor(i,this.stride);return s.setUsage(this.usage),s}onUpload(t){return this.onUploadCallback=t,this}toJSON(t){t.arrayBuffers===void 0&&(t.arrayBuffers={});let e=Hm(this.array);t.arrayBuffers[e]===void 0&&(t.arrayBuffers[e]=Array.from(new Uint32Array(this.array.slice(0).buffer)));let i={uuid:this.uuid,buffer:e,type:this.array.constructor.name,stride:this.stride};return i.usage=this.usage,i}};function Hm(n){return n.buffer._uuid===void 0&&(n.buffer._uuid=Ki()),n.byteOffset===0&&n.byteLength===n.buffer.byteLength?n.buffer._uuid:n.buffer._uuid+":"+n.byteOffset+":"+n.byteLength}var Ze=new N,Un=class n{constructor(t,e,i,s=!1){this.isInterleavedBufferAttribute=!0,this.name="",this.data=t,this.itemSize=e,this.offset=i,this.normalized=s,this._normalizationScale=t!==void 0?Vc(t.array):void 0}get count(){return this.data.count}get array(){return this.data.array}set needsUpdate(t){this.data.needsUpdate=t}applyMatrix4(t){for(let e=0,i=this.data.count;e<i;e++)Ze.fromBufferAttribute(this,e),Ze.applyMatrix4(t),this.setXYZ(e,Ze.x,Ze.y,Ze.z);return this}applyNormalMatrix(t){for(let e=0,i=this.count;e<i;e++)Ze.fromBufferAttribute(this,e),Ze.applyNormalMatrix(t),this.setXYZ(e,Ze.x,Ze.y,Ze.z);return this}transformDirection(t){for(let e=0,i=this.count;e<i;e++)Ze.fromBufferAttribute(this,e),Ze.transformDirection(t),this.setXYZ(e,Ze.x,Ze.y,Ze.z);return this}getComponent(t,e){let i=this.array[t*this.data.stride+this.offset+e];return this.normalized&&(i=this._denormalize(i)),i}setComponent(t,e,i){return this.normalized&&(i=this._normalize(i)),this.data.array[t*this.data.stride+this.offset+e]=i,this}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset]=e,this}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset+1]=e,this}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset+2]=e,this}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset+3]=e,this}getX(t){let e=this.data.array[t*this.data.stride+this.offset];return this.normalized&&(e=this._denormalize(e)),e}getY(t){let e=this.data.array[t*this.data.stride+this.offset+1];return this.normalized&&(e=this._denormalize(e)),e}getZ(t){let e=this.data.array[t*this.data.stride+this.offset+2];return this.normalized&&(e=this._denormalize(e)),e}getW(t){let e=this.data.array[t*this.data.stride+this.offset+3];return this.normalized&&(e=this._denormalize(e)),e}setXY(t,e,i){return t=t*this.data.stride+this.offset,this.normalized&&(e=this._normalize(e),i=this._normalize(i)),this.data.array[t+0]=e,this.data.array[t+1]=i,this}setXYZ(t,e,i,s){return t=t*this.data.stride+this.offset,this.normalized&&(e=this._normalize(e),i=this._normalize(i),s=this._normalize(s)),this.data.array[t+0]=e,this.data.array[t+1]=i,this.data.array[t+2]=s,this}setXYZW(t,e,i,s,r){return t=t*this.data.stride+this.offset,this.normalized&&(e=this._normalize(e),i=this._normalize(i),s=this._normalize(s),r=this._normalize(r)),this.data.array[t+0]=e,this.data.array[t+1]=i,this.data.array[t+2]=s,this.data.array[t+3]=r,this}clone(t){if(t===void 0){go("InterleavedBufferAttribute.clone(): Cloning an interleaved buffer attribute will de-interleave buffer data.");let e=[];for(let i=0;i<this.count;i++){let s=i*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)e.push(this.data.array[s+r])}return new Ln(new this.array.constructor(e),this.itemSize,this.normalized)}else return t.interleavedBuffers===void 0&&(t.interleavedBuffers={}),t.interleavedBuffers[this.data.uuid]===void 0&&(t.interleavedBuffers[this.data.uuid]=this.data.clone(t)),new n(t.interleavedBuffers[this.data.uuid],this.itemSize,this.offset,this.normalized)}toJSON(t){if(t===void 0){go("InterleavedBufferAttribute.toJSON(): Serializing an interleaved buffer attribute will de-interleave buffer data.");let e=[];for(let i=0;i<this.count;i++){let s=i*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)e.push(this.data.array[s+r])}return{itemSize:this.itemSize,type:this.array.constructor.name,array:e,normalized:this.normalized}}else return t.interleavedBuffers===void 0&&(t.interleavedBuffers={}),t.interleavedBuffers[this.data.uuid]===void 0&&(t.interleavedBuffers[this.data.uuid]=this.data.toJSON(t)),{isInterleavedBufferAttribute:!0,itemSize:this.itemSize,data:this.data.uuid,offset:this.offset,normalized:this.normalized}}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):yf(t,this.data.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):vf(t,this.data.array)}},Ru=new N,Jv=new N,Kv=new Ut,Ke=class{constructor(t=new N(1,0,0),e=0){this.isPlane=!0,this.normal=t,this.constant=e}set(t,e){return this.normal.copy(t),this.constant=e,this}setComponents(t,e,i,s){return this.normal.set(t,e,i),this.constant=s,this}setFromNormalAndCoplanarPoint(t,e){return this.normal.copy(t),this.constant=-e.dot(this.normal),this}setFromCoplanarPoints(t,e,i){let s=Ru.subVectors(i,e).cross(Jv.subVectors(t,e)).normalize();return this.setFromNormalAndCoplanarPoint(s,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){let t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,e){return e.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,e,i=!0){let s=t.delta(Ru),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(t.start)===0?e.copy(t.start):null;let o=-(t.start.dot(this.normal)+this.constant)/r;return i===!0&&(o<0||o>1)?null:e.copy(t.start).addScaledVector(s,o)}intersectsLine(t){let e=this.distanceToPoint(t.start),i=this.distanceToPoint(t.end);return e<0&&i>0||i<0&&e>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,e){let i=e||Kv.getNormalMatrix(t),s=this.coplanarPoint(Ru).applyMatrix4(t),r=this.normal.applyMatrix3(i).normalize();return this.constant=-s.dot(r),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(t){return this.normal.fromArray(t.normal),this.constant=t.constant,this}},jv=0,vi=class extends Nn{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:jv++}),this.uuid=Ki(),this.name="",this.type="Material",this.blending=Cr,this.side=Zi,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Yu,this.blendDst=Zu,this.blendEquation=Ts,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new zt(0,0,0),this.blendAlpha=0,this.depthFunc=_r,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=Ug,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=yl,this.stencilZFail=yl,this.stencilZPass=yl,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(let e in t){let i=t[e];if(i===void 0){It(`Material: parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){It(`Material: '${e}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(i):s&&s.isVector2&&i&&i.isVector2||s&&s.isEuler&&i&&i.isEuler||s&&s.isVector3&&i&&i.isVector3?s.copy(i):this[e]=i}}toJSON(t){let e=t===void 0||typeof t=="string";e&&(t={textures:{},images:{}});let i={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};i.uuid=this.uuid,i.type=this.type,i.blending=this.blending,i.side=this.side,i.shadowSide=this.shadowSide,i.vertexColors=this.vertexColors,i.opacity=this.opacity,i.transparent=this.transparent,i.blendSrc=this.blendSrc,i.blendDst=this.blendDst,i.blendEquation=this.blendEquation,i.blendSrcAlpha=this.blendSrcAlpha,i.blendDstAlpha=this.blendDstAlpha,i.blendEquationAlpha=this.blendEquationAlpha,i.blendColor=this.blendColor.getHex(),i.blendAlpha=this.blendAlpha,i.depthFunc=this.depthFunc,i.depthTest=this.depthTest,i.depthWrite=this.depthWrite,i.colorWrite=this.colorWrite,i.clipIntersection=this.clipIntersection,i.clipShadows=this.clipShadows,i.stencilWriteMask=this.stencilWriteMask,i.stencilFunc=this.stencilFunc,i.stencilRef=this.stencilRef,i.stencilFuncMask=this.stencilFuncMask,i.stencilFail=this.stencilFail,i.stencilZFail=this.stencilZFail,i.stencilZPass=this.stencilZPass,i.stencilWrite=this.stencilWrite,i.polygonOffset=this.polygonOffset,i.polygonOffsetFactor=this.polygonOffsetFactor,i.polygonOffsetUnits=this.polygonOffsetUnits,i.dithering=this.dithering,i.alphaTest=this.alphaTest,i.alphaHash=this.alphaHash,i.alphaToCoverage=this.alphaToCoverage,i.premultipliedAlpha=this.premultipliedAlpha,i.forceSinglePass=this.forceSinglePass,i.allowOverride=this.allowOverride,i.visible=this.visible,i.toneMapped=this.toneMapped,i.name=this.name,this.color&&this.color.isColor&&(i.color=this.color.getHex()),this.roughness!==void 0&&(i.roughness=this.roughness),this.metalness!==void 0&&(i.metalness=this.metalness),this.sheen!==void 0&&(i.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(i.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(i.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(i.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(i.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(i.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(i.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(i.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(i.shininess=this.shininess),this.clearcoat!==void 0&&(i.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(i.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(i.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(i.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(t).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(i.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(i.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(i.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,i.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(i.sheenColorMap=this.sheenColorMap.toJSON(t).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(i.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(t).uuid),this.dispersion!==void 0&&(i.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(i.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(i.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(i.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(i.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(i.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(i.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(i.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(i.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(i.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(i.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(i.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(i.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(i.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(i.lightMap=this.lightMap.toJSON(t).uuid,i.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(i.aoMap=this.aoMap.toJSON(t).uuid,i.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(i.bumpMap=this.bumpMap.toJSON(t).uuid,i.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(i.normalMap=this.normalMap.toJSON(t).uuid,i.normalMapType=this.normalMapType,i.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(i.displacementMap=this.displacementMap.toJSON(t).uuid,i.displacementScale=this.displacementScale,i.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(i.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(i.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(i.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(i.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(i.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(i.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(i.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(i.combine=this.combine)),this.envMapRotation!==void 0&&(i.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(i.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(i.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(i.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(i.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(i.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(i.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(i.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(i.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&(i.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(i.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(i.size=this.size),this.sizeAttenuation!==void 0&&(i.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(i.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(i.rotation=this.rotation),this.depthPacking!==void 0&&(i.depthPacking=this.depthPacking),this.linewidth!==void 0&&(i.linewidth=this.linewidth),this.linecap!==void 0&&(i.linecap=this.linecap),this.linejoin!==void 0&&(i.linejoin=this.linejoin),this.dashSize!==void 0&&(i.dashSize=this.dashSize),this.gapSize!==void 0&&(i.gapSize=this.gapSize),this.scale!==void 0&&(i.scale=this.scale),this.wireframe!==void 0&&(i.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(i.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(i.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(i.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(i.flatShading=this.flatShading),this.fog!==void 0&&(i.fog=this.fog),Object.keys(this.userData).length>0&&(i.userData=this.userData);function s(r){let o=[];for(let a in r){let c=r[a];delete c.metadata,o.push(c)}return o}if(e){let r=s(t.textures),o=s(t.images);r.length>0&&(i.textures=r),o.length>0&&(i.images=o)}return i}fromJSON(t,e){if(t.uuid!==void 0&&(this.uuid=t.uuid),t.name!==void 0&&(this.name=t.name),t.color!==void 0&&this.color!==void 0&&this.color.setHex(t.color),t.roughness!==void 0&&(this.roughness=t.roughness),t.metalness!==void 0&&(this.metalness=t.metalness),t.sheen!==void 0&&(this.sheen=t.sheen),t.sheenColor!==void 0&&(this.sheenColor=new zt().setHex(t.sheenColor)),t.sheenRoughness!==void 0&&(this.sheenRoughness=t.sheenRoughness),t.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(t.emissive),t.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(t.specular),t.specularIntensity!==void 0&&(this.specularIntensity=t.specularIntensity),t.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(t.specularColor),t.shininess!==void 0&&(this.shininess=t.shininess),t.clearcoat!==void 0&&(this.clearcoat=t.clearcoat),t.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=t.clearcoatRoughness),t.diffuseRoughness!==void 0&&(this.diffuseRoughness=t.diffuseRoughness),t.dispersion!==void 0&&(this.dispersion=t.dispersion),t.retroreflectivity!==void 0&&(this.retroreflectivity=t.retroreflectivity),t.iridescence!==void 0&&(this.iridescence=t.iridescence),t.iridescenceIOR!==void 0&&(this.iridescenceIOR=t.iridescenceIOR),t.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessMinimum),t.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=t.iridescenceThicknessMaximum),t.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=t.iridescenceThicknessRange[1]),t.transmission!==void 0&&(this.transmission=t.transmission),t.thickness!==void 0&&(this.thickness=t.thickness),t.attenuationDistance!==void 0&&(this.attenuationDistance=t.attenuationDistance),t.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(t.attenuationColor),t.anisotropy!==void 0&&(this.anisotropy=t.anisotropy),t.anisotropyRotation!==void 0&&(this.anisotropyRotation=t.anisotropyRotation),t.fog!==void 0&&(this.fog=t.fog),t.flatShading!==void 0&&(this.flatShading=t.flatShading),t.blending!==void 0&&(this.blending=t.blending),t.combine!==void 0&&(this.combine=t.combine),t.side!==void 0&&(this.side=t.side),t.shadowSide!==void 0&&(this.shadowSide=t.shadowSide),t.opacity!==void 0&&(this.opacity=t.opacity),t.transparent!==void 0&&(this.transparent=t.transparent),t.alphaTest!==void 0&&(this.alphaTest=t.alphaTest),t.alphaHash!==void 0&&(this.alphaHash=t.alphaHash),t.depthFunc!==void 0&&(this.depthFunc=t.depthFunc),t.depthTest!==void 0&&(this.depthTest=t.depthTest),t.depthWrite!==void 0&&(this.depthWrite=t.depthWrite),t.colorWrite!==void 0&&(this.colorWrite=t.colorWrite),t.clippingPlanes!==void 0&&(this.clippingPlanes=t.clippingPlanes.map(i=>new Ke().fromJSON(i))),t.clipIntersection!==void 0&&(this.clipIntersection=t.clipIntersection),t.clipShadows!==void 0&&(this.clipShadows=t.clipShadows),t.depthPacking!==void 0&&(this.depthPacking=t.depthPacking),t.blendSrc!==void 0&&(this.blendSrc=t.blendSrc),t.blendDst!==void 0&&(this.blendDst=t.blendDst),t.blendEquation!==void 0&&(this.blendEquation=t.blendEquation),t.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=t.blendSrcAlpha),t.blendDstAlpha!==void 0&&(this.blendDstAlpha=t.blendDstAlpha),t.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=t.blendEquationAlpha),t.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(t.blendColor),t.blendAlpha!==void 0&&(this.blendAlpha=t.blendAlpha),t.stencilWriteMask!==void 0&&(this.stencilWriteMask=t.stencilWriteMask),t.stencilFunc!==void 0&&(this.stencilFunc=t.stencilFunc),t.stencilRef!==void 0&&(this.stencilRef=t.stencilRef),t.stencilFuncMask!==void 0&&(this.stencilFuncMask=t.stencilFuncMask),t.stencilFail!==void 0&&(this.stencilFail=t.stencilFail),t.stencilZFail!==void 0&&(this.stencilZFail=t.stencilZFail),t.stencilZPass!==void 0&&(this.stencilZPass=t.stencilZPass),t.stencilWrite!==void 0&&(this.stencilWrite=t.stencilWrite),t.wireframe!==void 0&&(this.wireframe=t.wireframe),t.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=t.wireframeLinewidth),t.wireframeLinecap!==void 0&&(this.wireframeLinecap=t.wireframeLinecap),t.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=t.wireframeLinejoin),t.rotation!==void 0&&(this.rotation=t.rotation),t.linewidth!==void 0&&(this.linewidth=t.linewidth),t.linecap!==void 0&&(this.linecap=t.linecap),t.linejoin!==void 0&&(this.linejoin=t.linejoin),t.dashSize!==void 0&&(this.dashSize=t.dashSize),t.gapSize!==void 0&&(this.gapSize=t.gapSize),t.scale!==void 0&&(this.scale=t.scale),t.polygonOffset!==void 0&&(this.polygonOffset=t.polygonOffset),t.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=t.polygonOffsetFactor),t.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=t.polygonOffsetUnits),t.dithering!==void 0&&(this.dithering=t.dithering),t.alphaToCoverage!==void 0&&(this.alphaToCoverage=t.alphaToCoverage),t.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=t.premultipliedAlpha),t.forceSinglePass!==void 0&&(this.forceSinglePass=t.forceSinglePass),t.allowOverride!==void 0&&(this.allowOverride=t.allowOverride),t.visible!==void 0&&(this.visible=t.visible),t.toneMapped!==void 0&&(this.toneMapped=t.toneMapped),t.userData!==void 0&&(this.userData=t.userData),t.vertexColors!==void 0&&(typeof t.vertexColors=="number"?this.vertexColors=t.vertexColors>0:this.vertexColors=t.vertexColors),t.size!==void 0&&(this.size=t.size),t.sizeAttenuation!==void 0&&(this.sizeAttenuation=t.sizeAttenuation),t.map!==void 0&&(this.map=e[t.map]||null),t.matcap!==void 0&&(this.matcap=e[t.matcap]||null),t.alphaMap!==void 0&&(this.alphaMap=e[t.alphaMap]||null),t.bumpMap!==void 0&&(this.bumpMap=e[t.bumpMap]||null),t.bumpScale!==void 0&&(this.bumpScale=t.bumpScale),t.normalMap!==void 0&&(this.normalMap=e[t.normalMap]||null),t.normalMapType!==void 0&&(this.normalMapType=t.normalMapType),t.normalScale!==void 0){let i=t.normalScale;Array.isArray(i)===!1&&(i=[i,i]),this.normalScale=new Rt().fromArray(i)}return t.displacementMap!==void 0&&(this.displacementMap=e[t.displacementMap]||null),t.displacementScale!==void 0&&(this.displacementScale=t.displacementScale),t.displacementBias!==void 0&&(this.displacementBias=t.displacementBias),t.roughnessMap!==void 0&&(this.roughnessMap=e[t.roughnessMap]||null),t.metalnessMap!==void 0&&(this.metalnessMap=e[t.metalnessMap]||null),t.emissiveMap!==void 0&&(this.emissiveMap=e[t.emissiveMap]||null),t.emissiveIntensity!==void 0&&(this.emissiveIntensity=t.emissiveIntensity),t.specularMap!==void 0&&(this.specularMap=e[t.specularMap]||null),t.specularIntensityMap!==void 0&&(this.specularIntensityMap=e[t.specularIntensityMap]||null),t.specularColorMap!==void 0&&(this.specularColorMap=e[t.specularColorMap]||null),t.envMap!==void 0&&(this.envMap=e[t.envMap]||null),t.envMapRotation!==void 0&&this.envMapRotation.fromArray(t.envMapRotation),t.envMapIntensity!==void 0&&(this.envMapIntensity=t.envMapIntensity),t.reflectivity!==void 0&&(this.reflectivity=t.reflectivity),t.refractionRatio!==void 0&&(this.refractionRatio=t.refractionRatio),t.lightMap!==void 0&&(this.lightMap=e[t.lightMap]||null),t.lightMapIntensity!==void 0&&(this.lightMapIntensity=t.lightMapIntensity),t.aoMap!==void 0&&(this.aoMap=e[t.aoMap]||null),t.aoMapIntensity!==void 0&&(this.aoMapIntensity=t.aoMapIntensity),t.gradientMap!==void 0&&(this.gradientMap=e[t.gradientMap]||null),t.clearcoatMap!==void 0&&(this.clearcoatMap=e[t.clearcoatMap]||null),t.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=e[t.clearcoatRoughnessMap]||null),t.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=e[t.clearcoatNormalMap]||null),t.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new Rt().fromArray(t.clearcoatNormalScale)),t.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=e[t.diffuseRoughnessMap]||null),t.iridescenceMap!==void 0&&(this.iridescenceMap=e[t.iridescenceMap]||null),t.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=e[t.iridescenceThicknessMap]||null),t.transmissionMap!==void 0&&(this.transmissionMap=e[t.transmissionMap]||null),t.thicknessMap!==void 0&&(this.thicknessMap=e[t.thicknessMap]||null),t.anisotropyMap!==void 0&&(this.anisotropyMap=e[t.anisotropyMap]||null),t.sheenColorMap!==void 0&&(this.sheenColorMap=e[t.sheenColorMap]||null),t.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=e[t.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;let e=t.clippingPlanes,i=null;if(e!==null){let s=e.length;i=new Array(s);for(let r=0;r!==s;++r)i[r]=e[r].clone()}return this.clippingPlanes=i,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.allowOverride=t.allowOverride,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}};var mi=new N,Pu=new N,Qa=new N,tl=new N,zi=class{constructor(t=new N,e=new N(0,0,-1)){this.origin=t,this.direction=e}set(t,e){return this.origin.copy(t),this.direction.copy(e),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,e){return e.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,mi)),this}closestPointToPoint(t,e){e.subVectors(t,this.origin);let i=e.dot(this.direction);return i<0?e.copy(this.origin):e.copy(this.origin).addScaledVector(this.direction,i)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){let e=mi.subVectors(t,this.origin).dot(this.direction);return e<0?this.origin.distanceToSquared(t):(mi.copy(this.origin).addScaledVector(this.direction,e),mi.distanceToSquared(t))}distanceSqToSegment(t,e,i,s){Pu.copy(t).add(e).multiplyScalar(.5),Qa.copy(e).sub(t).normalize(),tl.copy(this.origin).sub(Pu);let r=t.distanceTo(e)*.5,o=-this.direction.dot(Qa),a=tl.dot(this.direction),c=-tl.dot(Qa),l=tl.lengthSq(),h=Math.abs(1-o*o),u,f,d,g;if(h>0)if(u=o*c-a,f=o*a-c,g=r*h,u>=0)if(f>=-g)if(f<=g){let _=1/h;u*=_,f*=_,d=u*(u+o*f+2*a)+f*(o*u+f+2*c)+l}else f=r,u=Math.max(0,-(o*f+a)),d=-u*u+f*(f+2*c)+l;else f=-r,u=Math.max(0,-(o*f+a)),d=-u*u+f*(f+2*c)+l;else f<=-g?(u=Math.max(0,-(-o*r+a)),f=u>0?-r:Math.min(Math.max(-r,-c),r),d=-u*u+f*(f+2*c)+l):f<=g?(u=0,f=Math.min(Math.max(-r,-c),r),d=f*(f+2*c)+l):(u=Math.max(0,-(o*r+a)),f=u>0?r:Math.min(Math.max(-r,-c),r),d=-u*u+f*(f+2*c)+l);else f=o>0?-r:r,u=Math.max(0,-(o*f+a)),d=-u*u+f*(f+2*c)+l;return i&&i.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(Pu).addScaledVector(Qa,f),d}intersectSphere(t,e){if(t.radius<0)return null;mi.subVectors(t.center,this.origin);let i=mi.dot(this.direction),s=mi.dot(mi)-i*i,r=t.radius*t.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=i-o,c=i+o;return c<0?null:a<0?this.at(c,e):this.at(a,e)}intersectsSphere(t){return t.radius<0?!1:this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){let e=t.normal.dot(this.direction);if(e===0)return t.distanceToPoint(this.origin)===0?0:null;let i=-(this.origin.dot(t.normal)+t.constant)/e;return i>=0?i:null}intersectPlane(t,e){let i=this.distanceToPlane(t);return i===null?null:this.at(i,e)}intersectsPlane(t){let e=t.distanceToPoint(this.origin);return e===0||t.normal.dot(this.direction)*e<0}intersectBox(t,e){let i,s,r,o,a,c,l=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,f=this.origin;return l>=0?(i=(t.min.x-f.x)*l,s=(t.max.x-f.x)*l):(i=(t.max.x-f.x)*l,s=(t.min.x-f.x)*l),h>=0?(r=(t.min.y-f.y)*h,o=(t.max.y-f.y)*h):(r=(t.max.y-f.y)*h,o=(t.min.y-f.y)*h),i>o||r>s||((r>i||isNaN(i))&&(i=r),(o<s||isNaN(s))&&(s=o),u>=0?(a=(t.min.z-f.z)*u,c=(t.max.z-f.z)*u):(a=(t.max.z-f.z)*u,c=(t.min.z-f.z)*u),i>c||a>s)||((a>i||i!==i)&&(i=a),(c<s||s!==s)&&(s=c),s<0)?null:this.at(i>=0?i:s,e)}intersectsBox(t){return this.intersectBox(t,mi)!==null}intersectTriangle(t,e,i,s,r){let o=this.origin,a=this.direction,c=a.x,l=a.y,h=a.z,u=t.x-o.x,f=t.y-o.y,d=t.z-o.z,g=e.x-o.x,_=e.y-o.y,p=e.z-o.z,m=i.x-o.x,y=i.y-o.y,S=i.z-o.z,v=Math.abs(c),A=Math.abs(l),E=Math.abs(h),x,w,U,C,L,I,B,R,W,q,H,K;if(v>=A&&v>=E?(U=c,I=u,W=g,K=m,c>=0?(x=l,w=h,C=f,L=d,B=_,R=p,q=y,H=S):(x=h,w=l,C=d,L=f,B=p,R=_,q=S,H=y)):A>=E?(U=l,I=f,W=_,K=y,l>=0?(x=h,w=c,C=d,L=u,B=p,R=g,q=S,H=m):(x=c,w=h,C=u,L=d,B=g,R=p,q=m,H=S)):(U=h,I=d,W=p,K=S,h>=0?(x=c,w=l,C=u,L=f,B=g,R=_,q=m,H=y):(x=l,w=c,C=f,L=u,B=_,R=g,q=y,H=m)),U===0)return null;let X=x/U,Y=w/U,rt=1/U,Z=C-X*I,ot=L-Y*I,z=B-X*W,it=R-Y*W,F=q-X*K,et=H-Y*K,st=F*it-et*z,Mt=Z*et-ot*F,Wt=z*ot-it*Z;if(s){if(st<0||Mt<0||Wt<0)return null}else if((st<0||Mt<0||Wt<0)&&(st>0||Mt>0||Wt>0))return null;let yt=st+Mt+Wt;if(yt===0)return null;let Nt=rt*(st*I+Mt*W+Wt*K);return(yt>0?Nt<0:Nt>0)?null:this.at(Nt/yt,r)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},On=class extends vi{constructor(t){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new zt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new yi,this.combine=tc,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}},Wm=new oe,vs=new zi,el=new Dn,Xm=new N,nl=new N,il=new N,sl=new N,Iu=new N,rl=new N,$m=new N,ol=new N,_e=class extends $e{constructor(t=new ue,e=new On){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){let e=this.geometry.morphAttributes,i=Object.keys(e);if(i.length>0){let s=e[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(t,e){let i=this.geometry,s=i.attributes.position,r=i.morphAttributes.position,o=i.morphTargetsRelative;e.fromBufferAttribute(s,t);let a=this.morphTargetInfluences;if(r&&a){rl.set(0,0,0);for(let c=0,l=r.length;c<l;c++){let h=a[c],u=r[c];h!==0&&(Iu.fromBufferAttribute(u,t),o?rl.addScaledVector(Iu,h):rl.addScaledVector(Iu.sub(e),h))}e.add(rl)}return e}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let i=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(i.boundingSphere===null&&i.computeBoundingSphere(),el.copy(i.boundingSphere),el.applyMatrix4(r),vs.copy(t.ray).recast(t.near),!(el.containsPoint(vs.origin)===!1&&(vs.intersectSphere(el,Xm)===null||vs.origin.distanceToSquared(Xm)>(t.far-t.near)**2))&&(Wm.copy(r).invert(),vs.copy(t.ray).applyMatrix4(Wm),!(i.boundingBox!==null&&vs.intersectsBox(i.boundingBox)===!1)&&this._computeIntersections(t,e,vs)))}_computeIntersections(t,e,i){let s,r=this.geometry,o=this.material,a=r.index,c=r.attributes.position,l=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,f=r.groups,d=r.drawRange;if(a!==null)if(Array.isArray(o))for(let g=0,_=f.length;g<_;g++){let p=f[g],m=o[p.materialIndex],y=Math.max(p.start,d.start),S=Math.min(a.count,Math.min(p.start+p.count,d.start+d.count));for(let v=y,A=S;v<A;v+=3){let E=a.getX(v),x=a.getX(v+1),w=a.getX(v+2);s=al(this,m,t,i,l,h,u,E,x,w),s&&(s.faceIndex=Math.floor(v/3),s.face.materialIndex=p.materialIndex,e.push(s))}}else{let g=Math.max(0,d.start),_=Math.min(a.count,d.start+d.count);for(let p=g,m=_;p<m;p+=3){let y=a.getX(p),S=a.getX(p+1),v=a.getX(p+2);s=al(this,o,t,i,l,h,u,y,S,v),s&&(s.faceIndex=Math.floor(p/3),e.push(s))}}else if(c!==void 0)if(Array.isArray(o))for(let g=0,_=f.length;g<_;g++){let p=f[g],m=o[p.materialIndex],y=Math.max(p.start,d.start),S=Math.min(c.count,Math.min(p.start+p.count,d.start+d.count));for(let v=y,A=S;v<A;v+=3){let E=v,x=v+1,w=v+2;s=al(this,m,t,i,l,h,u,E,x,w),s&&(s.faceIndex=Math.floor(v/3),s.face.materialIndex=p.materialIndex,e.push(s))}}else{let g=Math.max(0,d.start),_=Math.min(c.count,d.start+d.count);for(let p=g,m=_;p<m;p+=3){let y=p,S=p+1,v=p+2;s=al(this,o,t,i,l,h,u,y,S,v),s&&(s.faceIndex=Math.floor(p/3),e.push(s))}}}};function Qv(n,t,e,i,s,r,o,a){let c;if(t.side===De?c=i.intersectTriangle(o,r,s,!0,a):c=i.intersectTriangle(s,r,o,t.side===Zi,a),c===null)return null;ol.copy(a),ol.applyMatrix4(n.matrixWorld);let l=e.ray.origin.distanceTo(ol);return l<e.near||l>e.far?null:{distance:l,point:ol.clone(),object:n}}function al(n,t,e,i,s,r,o,a,c,l){n.getVertexPosition(a,nl),n.getVertexPosition(c,il),n.getVertexPosition(l,sl);let h=Qv(n,t,e,i,nl,il,sl,$m);if(h){let u=new N;gi.getBarycoord($m,nl,il,sl,u),s&&(h.uv=gi.getInterpolatedAttribute(s,a,c,l,u,new Rt)),r&&(h.uv1=gi.getInterpolatedAttribute(r,a,c,l,u,new Rt)),o&&(h.normal=gi.getInterpolatedAttribute(o,a,c,l,u,new N),h.normal.dot(i.direction)>0&&h.normal.multiplyScalar(-1));let f={a,b:c,c:l,normal:new N,materialIndex:0};gi.getNormal(nl,il,sl,f.normal),h.face=f,h.barycoord=u}return h}var Dl=class extends tn{constructor(t=null,e=1,i=1,s,r,o,a,c,l=Ie,h=Ie,u,f){super(null,o,a,c,l,h,s,r,u,f),this.isDataTexture=!0,this.image={data:t,width:e,height:i},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var bs=new Dn,tb=new Rt(.5,.5),ll=new N,Vi=class{constructor(t=new Ke,e=new Ke,i=new Ke,s=new Ke,r=new Ke,o=new Ke){this.planes=[t,e,i,s,r,o]}set(t,e,i,s,r,o){let a=this.planes;return a[0].copy(t),a[1].copy(e),a[2].copy(i),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(t){let e=this.planes;for(let i=0;i<6;i++)e[i].copy(t.planes[i]);return this}setFromProjectionMatrix(t,e=bn,i=!1){let s=this.planes,r=t.elements,o=r[0],a=r[1],c=r[2],l=r[3],h=r[4],u=r[5],f=r[6],d=r[7],g=r[8],_=r[9],p=r[10],m=r[11],y=r[12],S=r[13],v=r[14],A=r[15];if(s[0].setComponents(l-o,d-h,m-g,A-y).normalize(),s[1].setComponents(l+o,d+h,m+g,A+y).normalize(),s[2].setComponents(l+a,d+u,m+_,A+S).normalize(),s[3].setComponents(l-a,d-u,m-_,A-S).normalize(),i)s[4].setComponents(c,f,p,v).normalize(),s[5].setComponents(l-c,d-f,m-p,A-v).normalize();else if(s[4].setComponents(l-c,d-f,m-p,A-v).normalize(),e===bn)s[5].setComponents(l+c,d+f,m+p,A+v).normalize();else if(e===xr)s[5].setComponents(c,f,p,v).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+e);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),bs.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{let e=t.geometry;e.boundingSphere===null&&e.computeBoundingSphere(),bs.copy(e.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere(bs)}intersectsSprite(t){bs.center.set(0,0,0);let e=tb.distanceTo(t.center);return bs.radius=.7071067811865476+e,bs.applyMatrix4(t.matrixWorld),this.intersectsSphere(bs)}intersectsSphere(t){let e=this.planes,i=t.center,s=-t.radius;for(let r=0;r<6;r++)if(e[r].distanceToPoint(i)<s)return!1;return!0}intersectsBox(t){let e=this.planes;for(let i=0;i<6;i++){let s=e[i];if(ll.x=s.normal.x>0?t.max.x:t.min.x,ll.y=s.normal.y>0?t.max.y:t.min.y,ll.z=s.normal.z>0?t.max.z:t.min.z,s.distanceToPoint(ll)<0)return!1}return!0}containsPoint(t){let e=this.planes;for(let i=0;i<6;i++)if(e[i].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},qm=new oe,Ul=class n{constructor(){this.coordinateSystem=bn,this._frustums=[],this._count=0}setFromArrayCamera(t){let e=t.cameras,i=this._frustums;for(let s=0;s<e.length;s++){let r=e[s];qm.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),i[s]===void 0&&(i[s]=new Vi),i[s].setFromProjectionMatrix(qm,r.coordinateSystem,r.reversedDepth)}return this._count=e.length,this}getFrustum(t){return this._frustums[t]}intersectsObject(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsObject(t))return!0;return!1}intersectsSprite(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsSprite(t))return!0;return!1}intersectsSphere(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsSphere(t))return!0;return!1}intersectsBox(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsBox(t))return!0;return!1}containsPoint(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].containsPoint(t))return!0;return!1}copy(t){this.coordinateSystem=t.coordinateSystem;let e=this._frustums,i=t._frustums;for(let s=0;s<t._count;s++)e[s]===void 0&&(e[s]=new Vi),e[s].copy(i[s]);return this._count=t._count,this}clone(){return new n().copy(this)}};var Zn=class extends vi{constructor(t){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new zt(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.linewidth=t.linewidth,this.linecap=t.linecap,this.linejoin=t.linejoin,this.fog=t.fog,this}},Ol=new N,Fl=new N,Ym=new oe,lo=new zi,cl=new Dn,Lu=new N,Zm=new N,Bl=class extends $e{constructor(t=new ue,e=new Zn){super(),this.isLine=!0,this.type="Line",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,i=[0];for(let s=1,r=e.count;s<r;s++)Ol.fromBufferAttribute(e,s-1),Fl.fromBufferAttribute(e,s),i[s]=i[s-1],i[s]+=Ol.distanceTo(Fl);t.setAttribute("lineDistance",new Xt(i,1))}else It("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let i=this.geometry,s=this.matrixWorld,r=t.params.Line.threshold,o=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),cl.copy(i.boundingSphere),cl.applyMatrix4(s),cl.radius+=r,t.ray.intersectsSphere(cl)===!1)return;Ym.copy(s).invert(),lo.copy(t.ray).applyMatrix4(Ym);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),c=a*a,l=this.isLineSegments?2:1,h=i.index,f=i.attributes.position;if(h!==null){let d=Math.max(0,o.start),g=Math.min(h.count,o.start+o.count);for(let _=d,p=g-1;_<p;_+=l){let m=h.getX(_),y=h.getX(_+1),S=hl(this,t,lo,c,m,y,_);S&&e.push(S)}if(this.isLineLoop){let _=h.getX(g-1),p=h.getX(d),m=hl(this,t,lo,c,_,p,g-1);m&&e.push(m)}}else{let d=Math.max(0,o.start),g=Math.min(f.count,o.start+o.count);for(let _=d,p=g-1;_<p;_+=l){let m=hl(this,t,lo,c,_,_+1,_);m&&e.push(m)}if(this.isLineLoop){let _=hl(this,t,lo,c,g-1,d,g-1);_&&e.push(_)}}}updateMorphTargets(){let e=this.geometry.morphAttributes,i=Object.keys(e);if(i.length>0){let s=e[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function hl(n,t,e,i,s,r,o){let a=n.geometry.attributes.position;if(Ol.fromBufferAttribute(a,s),Fl.fromBufferAttribute(a,r),e.distanceSqToSegment(Ol,Fl,Lu,Zm)>i)return;Lu.applyMatrix4(n.matrixWorld);let l=t.ray.origin.distanceTo(Lu);if(!(l<t.near||l>t.far))return{distance:l,point:Zm.clone().applyMatrix4(n.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:n}}var Jm=new N,Km=new N,bi=class extends Bl{constructor(t,e){super(t,e),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,i=[];for(let s=0,r=e.count;s<r;s+=2)Jm.fromBufferAttribute(e,s),Km.fromBufferAttribute(e,s+1),i[s]=s===0?0:i[s-1],i[s+1]=i[s]+Jm.distanceTo(Km);t.setAttribute("lineDistance",new Xt(i,1))}else It("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var bo=class extends tn{constructor(t=[],e=Cs,i,s,r,o,a,c,l,h){super(t,e,i,s,r,o,a,c,l,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}},wr=class extends tn{constructor(t,e,i,s,r,o,a,c,l){super(t,e,i,s,r,o,a,c,l),this.isCanvasTexture=!0,this.needsUpdate=!0}};var Mi=class extends tn{constructor(t,e,i=Fn,s,r,o,a=Ie,c=Ie,l,h=xi,u=1){if(h!==xi&&h!==Ei)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let f={width:t,height:e,depth:u};super(f,s,r,o,a,c,h,i,l),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.source=new br(Object.assign({},t.image)),this.compareFunction=t.compareFunction,this}toJSON(t){let e=super.toJSON(t);return e.compareFunction=this.compareFunction,e}},Mo=class extends Mi{constructor(t,e=Fn,i=Cs,s,r,o=Ie,a=Ie,c,l=xi){let h={width:t,height:t,depth:1},u=[h,h,h,h,h,h];super(t,t,e,i,s,r,o,a,c,l),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(t){this.image=t}},So=class extends tn{constructor(t=null){super(),this.sourceTexture=t,this.isExternalTexture=!0}copy(t){return super.copy(t),this.sourceTexture=t.sourceTexture,this}},Si=class n extends ue{constructor(t=1,e=1,i=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:e,depth:i,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let c=[],l=[],h=[],u=[],f=0,d=0;g("z","y","x",-1,-1,i,e,t,o,r,0),g("z","y","x",1,-1,i,e,-t,o,r,1),g("x","z","y",1,1,t,i,e,s,o,2),g("x","z","y",1,-1,t,i,-e,s,o,3),g("x","y","z",1,-1,t,e,i,s,r,4),g("x","y","z",-1,-1,t,e,-i,s,r,5),this.setIndex(c),this.setAttribute("position",new Xt(l,3)),this.setAttribute("normal",new Xt(h,3)),this.setAttribute("uv",new Xt(u,2));function g(_,p,m,y,S,v,A,E,x,w,U){let C=v/x,L=A/w,I=v/2,B=A/2,R=E/2,W=x+1,q=w+1,H=0,K=0,X=new N;for(let Y=0;Y<q;Y++){let rt=Y*L-B;for(let Z=0;Z<W;Z++){let ot=Z*C-I;X[_]=ot*y,X[p]=rt*S,X[m]=R,l.push(X.x,X.y,X.z),X[_]=0,X[p]=0,X[m]=E>0?1:-1,h.push(X.x,X.y,X.z),u.push(Z/x),u.push(1-Y/w),H+=1}}for(let Y=0;Y<w;Y++)for(let rt=0;rt<x;rt++){let Z=f+rt+W*Y,ot=f+rt+W*(Y+1),z=f+(rt+1)+W*(Y+1),it=f+(rt+1)+W*Y;c.push(Z,ot,it),c.push(ot,z,it),K+=6}a.addGroup(d,K,U),d+=K,f+=H}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}};var wo=class n extends ue{constructor(t=1,e=32,i=0,s=Math.PI*2){super(),this.type="CircleGeometry",this.parameters={radius:t,segments:e,thetaStart:i,thetaLength:s},e=Math.max(3,e);let r=[],o=[],a=[],c=[],l=new N,h=new Rt;o.push(0,0,0),a.push(0,0,1),c.push(.5,.5);for(let u=0,f=3;u<=e;u++,f+=3){let d=i+u/e*s;l.x=t*Math.cos(d),l.y=t*Math.sin(d),o.push(l.x,l.y,l.z),a.push(0,0,1),h.x=(o[f]/t+1)/2,h.y=(o[f+1]/t+1)/2,c.push(h.x,h.y)}for(let u=1;u<=e;u++)r.push(u,u+1,0);this.setIndex(r),this.setAttribute("position",new Xt(o,3)),this.setAttribute("normal",new Xt(a,3)),this.setAttribute("uv",new Xt(c,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.radius,t.segments,t.thetaStart,t.thetaLength)}},Gi=class n extends ue{constructor(t=1,e=1,i=1,s=32,r=1,o=!1,a=0,c=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:t,radiusBottom:e,height:i,radialSegments:s,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:c};let l=this;s=Math.floor(s),r=Math.floor(r);let h=[],u=[],f=[],d=[],g=0,_=[],p=i/2,m=0;y(),o===!1&&(t>0&&S(!0),e>0&&S(!1)),this.setIndex(h),this.setAttribute("position",new Xt(u,3)),this.setAttribute("normal",new Xt(f,3)),this.setAttribute("uv",new Xt(d,2));function y(){let v=new N,A=new N,E=0,x=(e-t)/i;for(let w=0;w<=r;w++){let U=[],C=w/r,L=C*(e-t)+t;for(let I=0;I<=s;I++){let B=I/s,R=B*c+a,W=Math.sin(R),q=Math.cos(R);A.x=L*W,A.y=-C*i+p,A.z=L*q,u.push(A.x,A.y,A.z),v.set(W,x,q).normalize(),f.push(v.x,v.y,v.z),d.push(B,1-C),U.push(g++)}_.push(U)}for(let w=0;w<s;w++)for(let U=0;U<r;U++){let C=_[U][w],L=_[U+1][w],I=_[U+1][w+1],B=_[U][w+1];(t>0||U!==0)&&(h.push(C,L,B),E+=3),(e>0||U!==r-1)&&(h.push(L,I,B),E+=3)}l.addGroup(m,E,0),m+=E}function S(v){let A=g,E=new Rt,x=new N,w=0,U=v===!0?t:e,C=v===!0?1:-1;for(let I=1;I<=s;I++)u.push(0,p*C,0),f.push(0,C,0),d.push(.5,.5),g++;let L=g;for(let I=0;I<=s;I++){let R=I/s*c+a,W=Math.cos(R),q=Math.sin(R);x.x=U*q,x.y=p*C,x.z=U*W,u.push(x.x,x.y,x.z),f.push(0,C,0),E.x=W*.5+.5,E.y=q*.5*C+.5,d.push(E.x,E.y),g++}for(let I=0;I<s;I++){let B=A+I,R=L+I;v===!0?h.push(R,R+1,B):h.push(R+1,R,B),w+=3}l.addGroup(m,w,v===!0?1:2),m+=w}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.radiusTop,t.radiusBottom,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}},Eo=class n extends Gi{constructor(t=1,e=1,i=32,s=1,r=!1,o=0,a=Math.PI*2){super(0,t,e,i,s,r,o,a),this.type="ConeGeometry",this.parameters={radius:t,height:e,radialSegments:i,heightSegments:s,openEnded:r,thetaStart:o,thetaLength:a}}static fromJSON(t){return new n(t.radius,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}};var ul=new N,fl=new N,Nu=new N,dl=new gi,Ao=class extends ue{constructor(t=null,e=1){if(super(),this.type="EdgesGeometry",this.parameters={geometry:t,thresholdAngle:e},t!==null){let s=Math.pow(10,4),r=Math.cos(mr*e),o=t.getIndex(),a=t.getAttribute("position"),c=o?o.count:a.count,l=[0,0,0],h=["a","b","c"],u=new Array(3),f=new Map,d=[];for(let g=0;g<c;g+=3){o?(l[0]=o.getX(g),l[1]=o.getX(g+1),l[2]=o.getX(g+2)):(l[0]=g,l[1]=g+1,l[2]=g+2);let{a:_,b:p,c:m}=dl;if(_.fromBufferAttribute(a,l[0]),p.fromBufferAttribute(a,l[1]),m.fromBufferAttribute(a,l[2]),dl.getNormal(Nu),u[0]=`${Math.round(_.x*s)},${Math.round(_.y*s)},${Math.round(_.z*s)}`,u[1]=`${Math.round(p.x*s)},${Math.round(p.y*s)},${Math.round(p.z*s)}`,u[2]=`${Math.round(m.x*s)},${Math.round(m.y*s)},${Math.round(m.z*s)}`,!(u[0]===u[1]||u[1]===u[2]||u[2]===u[0]))for(let y=0;y<3;y++){let S=(y+1)%3,v=u[y],A=u[S],E=dl[h[y]],x=dl[h[S]],w=`${v}_${A}`,U=`${A}_${v}`,C=f.get(U);C?(Nu.dot(C.normal)<=r&&(d.push(E.x,E.y,E.z),d.push(x.x,x.y,x.z)),f.set(U,null)):f.has(w)||f.set(w,{index0:l[y],index1:l[S],normal:Nu.clone()})}}for(let g of f.values())if(g){let{index0:_,index1:p}=g;ul.fromBufferAttribute(a,_),fl.fromBufferAttribute(a,p),d.push(ul.x,ul.y,ul.z),d.push(fl.x,fl.y,fl.z)}this.setAttribute("position",new Xt(d,3))}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}};var Ms=class n extends ue{constructor(t=1,e=1,i=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:e,widthSegments:i,heightSegments:s};let r=t/2,o=e/2,a=Math.floor(i),c=Math.floor(s),l=a+1,h=c+1,u=t/a,f=e/c,d=[],g=[],_=[],p=[];for(let m=0;m<h;m++){let y=m*f-o;for(let S=0;S<l;S++){let v=S*u-r;g.push(v,-y,0),_.push(0,0,1),p.push(S/a),p.push(1-m/c)}}for(let m=0;m<c;m++)for(let y=0;y<a;y++){let S=y+l*m,v=y+l*(m+1),A=y+1+l*(m+1),E=y+1+l*m;d.push(S,v,E),d.push(v,A,E)}this.setIndex(d),this.setAttribute("position",new Xt(g,3)),this.setAttribute("normal",new Xt(_,3)),this.setAttribute("uv",new Xt(p,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.width,t.height,t.widthSegments,t.heightSegments)}},Ss=class n extends ue{constructor(t=.5,e=1,i=32,s=1,r=0,o=Math.PI*2){super(),this.type="RingGeometry",this.parameters={innerRadius:t,outerRadius:e,thetaSegments:i,phiSegments:s,thetaStart:r,thetaLength:o},i=Math.max(3,i),s=Math.max(1,s);let a=[],c=[],l=[],h=[],u=t,f=(e-t)/s,d=new N,g=new Rt;for(let _=0;_<=s;_++){for(let p=0;p<=i;p++){let m=r+p/i*o;d.x=u*Math.cos(m),d.y=u*Math.sin(m),c.push(d.x,d.y,d.z),l.push(0,0,1),g.x=(d.x/e+1)/2,g.y=(d.y/e+1)/2,h.push(g.x,g.y)}u+=f}for(let _=0;_<s;_++){let p=_*(i+1);for(let m=0;m<i;m++){let y=m+p,S=y,v=y+i+1,A=y+i+2,E=y+1;a.push(S,v,E),a.push(v,A,E)}}this.setIndex(a),this.setAttribute("position",new Xt(c,3)),this.setAttribute("normal",new Xt(l,3)),this.setAttribute("uv",new Xt(h,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.innerRadius,t.outerRadius,t.thetaSegments,t.phiSegments,t.thetaStart,t.thetaLength)}};var ws=class n extends ue{constructor(t=1,e=32,i=16,s=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:t,widthSegments:e,heightSegments:i,phiStart:s,phiLength:r,thetaStart:o,thetaLength:a},e=Math.max(3,Math.floor(e)),i=Math.max(2,Math.floor(i));let c=Math.min(o+a,Math.PI),l=0,h=[],u=new N,f=new N,d=[],g=[],_=[],p=[];for(let m=0;m<=i;m++){let y=[],S=m/i,v=o+S*a,A=t*Math.cos(v),E=Math.sqrt(t*t-A*A),x=0;m===0&&o===0?x=.5/e:m===i&&c===Math.PI&&(x=-.5/e);for(let w=0;w<=e;w++){let U=w/e,C=s+U*r;u.x=-E*Math.cos(C),u.y=A,u.z=E*Math.sin(C),g.push(u.x,u.y,u.z),f.copy(u).normalize(),_.push(f.x,f.y,f.z),p.push(U+x,1-S),y.push(l++)}h.push(y)}for(let m=0;m<i;m++)for(let y=0;y<e;y++){let S=h[m][y+1],v=h[m][y],A=h[m+1][y],E=h[m+1][y+1];(m!==0||o>0)&&d.push(S,v,E),(m!==i-1||c<Math.PI)&&d.push(v,A,E)}this.setIndex(d),this.setAttribute("position",new Xt(g,3)),this.setAttribute("normal",new Xt(_,3)),this.setAttribute("uv",new Xt(p,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.radius,t.widthSegments,t.heightSegments,t.phiStart,t.phiLength,t.thetaStart,t.thetaLength)}};var To=class extends ue{constructor(t=null){if(super(),this.type="WireframeGeometry",this.parameters={geometry:t},t!==null){let e=[],i=new Set,s=new N,r=new N;if(t.index!==null){let o=t.attributes.position,a=t.index,c=t.groups;c.length===0&&(c=[{start:0,count:a.count,materialIndex:0}]);for(let l=0,h=c.length;l<h;++l){let u=c[l],f=u.start,d=u.count;for(let g=f,_=f+d;g<_;g+=3)for(let p=0;p<3;p++){let m=a.getX(g+p),y=a.getX(g+(p+1)%3);s.fromBufferAttribute(o,m),r.fromBufferAttribute(o,y),jm(s,r,i)===!0&&(e.push(s.x,s.y,s.z),e.push(r.x,r.y,r.z))}}}else{let o=t.attributes.position;for(let a=0,c=o.count/3;a<c;a++)for(let l=0;l<3;l++){let h=3*a+l,u=3*a+(l+1)%3;s.fromBufferAttribute(o,h),r.fromBufferAttribute(o,u),jm(s,r,i)===!0&&(e.push(s.x,s.y,s.z),e.push(r.x,r.y,r.z))}}this.setAttribute("position",new Xt(e,3))}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}};function jm(n,t,e){let i=`${n.x},${n.y},${n.z}-${t.x},${t.y},${t.z}`,s=`${t.x},${t.y},${t.z}-${n.x},${n.y},${n.z}`;return e.has(i)===!0||e.has(s)===!0?!1:(e.add(i),e.add(s),!0)}function Ps(n){let t={};for(let e in n){t[e]={};for(let i in n[e]){let s=n[e][i];if(Qm(s))s.isRenderTargetTexture?(It("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[e][i]=null):t[e][i]=s.clone();else if(Array.isArray(s))if(Qm(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();t[e][i]=r}else t[e][i]=s.slice();else t[e][i]=s}}return t}function qe(n){let t={};for(let e=0;e<n.length;e++){let i=Ps(n[e]);for(let s in i)t[s]=i[s]}return t}function Qm(n){return n&&(n.isColor||n.isMatrix3||n.isMatrix4||n.isVector2||n.isVector3||n.isVector4||n.isTexture||n.isQuaternion)}function eb(n){let t=[];for(let e=0;e<n.length;e++)t.push(n[e].clone());return t}function bf(n){let t=n.getRenderTarget();return t===null?n.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:Yt.workingColorSpace}var qo={clone:Ps,merge:qe},nb=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,ib=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,Mn=class extends vi{constructor(t){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=nb,this.fragmentShader=ib,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=Ps(t.uniforms),this.uniformsGroups=eb(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this.defaultAttributeValues=Object.assign({},t.defaultAttributeValues),this.index0AttributeName=t.index0AttributeName,this.uniformsNeedUpdate=t.uniformsNeedUpdate,this}toJSON(t){let e=super.toJSON(t);e.glslVersion=this.glslVersion,e.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?e.uniforms[s]={type:"t",value:o.toJSON(t).uuid}:o&&o.isColor?e.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?e.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?e.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?e.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?e.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?e.uniforms[s]={type:"m4",value:o.toArray()}:e.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(e.defines=this.defines),e.vertexShader=this.vertexShader,e.fragmentShader=this.fragmentShader,e.lights=this.lights,e.clipping=this.clipping;let i={};for(let s in this.extensions)this.extensions[s]===!0&&(i[s]=!0);return Object.keys(i).length>0&&(e.extensions=i),e}fromJSON(t,e){if(super.fromJSON(t,e),t.uniforms!==void 0)for(let i in t.uniforms){let s=t.uniforms[i];switch(this.uniforms[i]={},s.type){case"t":this.uniforms[i].value=e[s.value]||null;break;case"c":this.uniforms[i].value=new zt().setHex(s.value);break;case"v2":this.uniforms[i].value=new Rt().fromArray(s.value);break;case"v3":this.uniforms[i].value=new N().fromArray(s.value);break;case"v4":this.uniforms[i].value=new ne().fromArray(s.value);break;case"m3":this.uniforms[i].value=new Ut().fromArray(s.value);break;case"m4":this.uniforms[i].value=new oe().fromArray(s.value);break;default:this.uniforms[i].value=s.value}}if(t.defines!==void 0&&(this.defines=t.defines),t.vertexShader!==void 0&&(this.vertexShader=t.vertexShader),t.fragmentShader!==void 0&&(this.fragmentShader=t.fragmentShader),t.glslVersion!==void 0&&(this.glslVersion=t.glslVersion),t.extensions!==void 0)for(let i in t.extensions)this.extensions[i]=t.extensions[i];return t.lights!==void 0&&(this.lights=t.lights),t.clipping!==void 0&&(this.clipping=t.clipping),this}},kl=class extends Mn{constructor(t){super(t),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var Es=class extends vi{constructor(t){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new zt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new zt(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=zc,this.normalScale=new Rt(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new yi,this.combine=tc,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.bumpMap=t.bumpMap,this.bumpScale=t.bumpScale,this.normalMap=t.normalMap,this.normalMapType=t.normalMapType,this.normalScale.copy(t.normalScale),this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.envMapIntensity=t.envMapIntensity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.flatShading=t.flatShading,this.fog=t.fog,this}},zl=class extends vi{constructor(t){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=Ng,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}},Vl=class extends vi{constructor(t){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}};function hr(n,t){return!n||n.constructor===t?n:typeof t.BYTES_PER_ELEMENT=="number"?new t(n):Array.prototype.slice.call(n)}function pl(n){return n!==void 0&&n.inTangents!==void 0&&n.outTangents!==void 0}var Hi=class{constructor(t,e,i,s){this.parameterPositions=t,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new e.constructor(i),this.sampleValues=e,this.valueSize=i,this.settings=null,this.DefaultSettings_={}}evaluate(t){let e=this.parameterPositions,i=this._cachedIndex,s=e[i],r=e[i-1];t:{e:{let o;n:{i:if(!(t<s)){for(let a=i+2;;){if(s===void 0){if(t<r)break i;return i=e.length,this._cachedIndex=i,this.copySampleValue_(i-1)}if(i===a)break;if(r=s,s=e[++i],t<s)break e}o=e.length;break n}if(!(t>=r)){let a=e[1];t<a&&(i=2,r=a);for(let c=i-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(i===c)break;if(s=r,r=e[--i-1],t>=r)break e}o=i,i=0;break n}break t}for(;i<o;){let a=i+o>>>1;t<e[a]?o=a:i=a+1}if(s=e[i],r=e[i-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return i=e.length,this._cachedIndex=i,this.copySampleValue_(i-1)}this._cachedIndex=i,this.intervalChanged_(i,r,s)}return this.interpolate_(i,r,t,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(t){let e=this.resultBuffer,i=this.sampleValues,s=this.valueSize,r=t*s;for(let o=0;o!==s;++o)e[o]=i[r+o];return e}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},Gl=class extends Hi{constructor(t,e,i,s){super(t,e,i,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:Fu,endingEnd:Fu}}intervalChanged_(t,e,i){let s=this.parameterPositions,r=t-2,o=t+1,a=s[r],c=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case Bu:r=t,a=2*e-i;break;case ku:r=s.length-2,a=e+s[r]-s[r+1];break;default:r=t,a=i}if(c===void 0)switch(this.getSettings_().endingEnd){case Bu:o=t,c=2*i-e;break;case ku:o=1,c=i+s[1]-s[0];break;default:o=t-1,c=e}let l=(i-e)*.5,h=this.valueSize;this._weightPrev=l/(e-a),this._weightNext=l/(c-i),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(t,e,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=t*a,l=c-a,h=this._offsetPrev,u=this._offsetNext,f=this._weightPrev,d=this._weightNext,g=(i-e)/(s-e),_=g*g,p=_*g,m=-f*p+2*f*_-f*g,y=(1+f)*p+(-1.5-2*f)*_+(-.5+f)*g+1,S=(-1-d)*p+(1.5+d)*_+.5*g,v=d*p-d*_;for(let A=0;A!==a;++A)r[A]=m*o[h+A]+y*o[l+A]+S*o[c+A]+v*o[u+A];return r}},Hl=class extends Hi{constructor(t,e,i,s){super(t,e,i,s)}interpolate_(t,e,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=t*a,l=c-a,h=(i-e)/(s-e),u=1-h;for(let f=0;f!==a;++f)r[f]=o[l+f]*u+o[c+f]*h;return r}},Wl=class extends Hi{constructor(t,e,i,s){super(t,e,i,s)}interpolate_(t){return this.copySampleValue_(t-1)}},Xl=class extends Hi{interpolate_(t,e,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=t*a,l=c-a,h=this.inTangents,u=this.outTangents;if(!h||!u){let g=(i-e)/(s-e),_=1-g;for(let p=0;p!==a;++p)r[p]=o[l+p]*_+o[c+p]*g;return r}let f=a*2,d=t-1;for(let g=0;g!==a;++g){let _=o[l+g],p=o[c+g],m=d*f+g*2,y=u[m],S=u[m+1],v=t*f+g*2,A=h[v],E=h[v+1],x=rb(i,e,y,A,s);r[g]=$g(x,_,S,E,p)}return r}};function $g(n,t,e,i,s){let r=1-n;return r*r*r*t+3*r*r*n*e+3*r*n*n*i+n*n*n*s}function sb(n,t,e,i,s){let r=1-n;return 3*r*r*(e-t)+6*r*n*(i-e)+3*n*n*(s-i)}function rb(n,t,e,i,s){let r=(n-t)/(s-t);for(let o=0;o<8;o++){let a=$g(r,t,e,i,s)-n;if(Math.abs(a)<1e-10)break;let c=sb(r,t,e,i,s);if(Math.abs(c)<1e-10)break;r=Math.max(0,Math.min(1,r-a/c))}return r}var pn=class{constructor(t,e,i,s){if(t===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(e===void 0||e.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+t);this.name=t,this.times=hr(e,this.TimeBufferType),this.values=hr(i,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(t){let e=t.constructor,i;if(e.toJSON!==this.toJSON)i=e.toJSON(t);else{i={name:t.name,times:hr(t.times,Array),values:hr(t.values,Array)};let s=t.getInterpolation();s!==t.DefaultInterpolation&&(i.interpolation=s),pl(t.settings)&&(i.settings={inTangents:hr(t.settings.inTangents,Array),outTangents:hr(t.settings.outTangents,Array)})}return i.type=t.ValueTypeName,i}InterpolantFactoryMethodDiscrete(t){return new Wl(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodLinear(t){return new Hl(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodSmooth(t){return new Gl(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodBezier(t){let e=new Xl(this.times,this.values,this.getValueSize(),t);return this.settings&&(e.inTangents=this.settings.inTangents,e.outTangents=this.settings.outTangents),e}setInterpolation(t){let e;switch(t){case uo:e=this.InterpolantFactoryMethodDiscrete;break;case Rl:e=this.InterpolantFactoryMethodLinear;break;case xl:e=this.InterpolantFactoryMethodSmooth;break;case Ou:e=this.InterpolantFactoryMethodBezier;break}if(e===void 0){let i="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(t!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(i);return It("KeyframeTrack:",i),this}return this.createInterpolant=e,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return uo;case this.InterpolantFactoryMethodLinear:return Rl;case this.InterpolantFactoryMethodSmooth:return xl;case this.InterpolantFactoryMethodBezier:return Ou}}getValueSize(){return this.values.length/this.times.length}shift(t){if(t!==0){let e=this.times;for(let i=0,s=e.length;i!==s;++i)e[i]+=t;pl(this.settings)&&(tg(this.settings.inTangents,t),tg(this.settings.outTangents,t))}return this}scale(t){if(t!==1){let e=this.times;for(let i=0,s=e.length;i!==s;++i)e[i]*=t;pl(this.settings)&&(eg(this.settings.inTangents,t),eg(this.settings.outTangents,t))}return this}trim(t,e){let i=this.times,s=i.length,r=0,o=s-1;for(;r!==s&&i[r]<t;)++r;for(;o!==-1&&i[o]>e;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=i.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let t=!0,e=this.getValueSize();e-Math.floor(e)!==0&&(Dt("KeyframeTrack: Invalid value size in track.",this),t=!1);let i=this.times,s=this.values,r=i.length;r===0&&(Dt("KeyframeTrack: Track is empty.",this),t=!1);let o=null;for(let a=0;a!==r;a++){let c=i[a];if(typeof c=="number"&&isNaN(c)){Dt("KeyframeTrack: Time is not a valid number.",this,a,c),t=!1;break}if(o!==null&&o>c){Dt("KeyframeTrack: Out of order keys.",this,a,c,o),t=!1;break}o=c}if(s!==void 0&&bv(s))for(let a=0,c=s.length;a!==c;++a){let l=s[a];if(isNaN(l)){Dt("KeyframeTrack: Value is not a valid number.",this,a,l),t=!1;break}}return t}optimize(){let t=this.times.slice(),e=this.values.slice(),i=this.getValueSize(),s=this.getInterpolation()===xl,r=t.length-1,o=1;for(let a=1;a<r;++a){let c=!1,l=t[a],h=t[a+1];if(l!==h&&(a!==1||l!==t[0]))if(s)c=!0;else{let u=a*i,f=u-i,d=u+i;for(let g=0;g!==i;++g){let _=e[u+g];if(_!==e[f+g]||_!==e[d+g]){c=!0;break}}}if(c){if(a!==o){t[o]=t[a];let u=a*i,f=o*i;for(let d=0;d!==i;++d)e[f+d]=e[u+d]}++o}}if(r>0){t[o]=t[r];for(let a=r*i,c=o*i,l=0;l!==i;++l)e[c+l]=e[a+l];++o}return o!==t.length?(this.times=t.slice(0,o),this.values=e.slice(0,o*i)):(this.times=t,this.values=e),this}clone(){let t=this.times.slice(),e=this.values.slice(),i=this.constructor,s=new i(this.name,t,e);return s.createInterpolant=this.createInterpolant,pl(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function tg(n,t){for(let e=0,i=n.length;e!==i;e+=2)n[e]+=t}function eg(n,t){for(let e=0,i=n.length;e!==i;e+=2)n[e]*=t}pn.prototype.ValueTypeName="";pn.prototype.TimeBufferType=Float32Array;pn.prototype.ValueBufferType=Float32Array;pn.prototype.DefaultInterpolation=Rl;var Wi=class extends pn{constructor(t,e,i){super(t,e,i)}};Wi.prototype.ValueTypeName="bool";Wi.prototype.ValueBufferType=Array;Wi.prototype.DefaultInterpolation=uo;Wi.prototype.InterpolantFactoryMethodLinear=void 0;Wi.prototype.InterpolantFactoryMethodSmooth=void 0;var $l=class extends pn{constructor(t,e,i,s){super(t,e,i,s)}};$l.prototype.ValueTypeName="color";var ql=class extends pn{constructor(t,e,i,s){super(t,e,i,s)}};ql.prototype.ValueTypeName="number";var Yl=class extends Hi{constructor(t,e,i,s){super(t,e,i,s)}interpolate_(t,e,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=(i-e)/(s-e),l=t*a;for(let h=l+a;l!==h;l+=4)Ne.slerpFlat(r,0,o,l-a,o,l,c);return r}},Co=class extends pn{constructor(t,e,i,s){super(t,e,i,s)}InterpolantFactoryMethodLinear(t){return new Yl(this.times,this.values,this.getValueSize(),t)}};Co.prototype.ValueTypeName="quaternion";Co.prototype.InterpolantFactoryMethodSmooth=void 0;var Xi=class extends pn{constructor(t,e,i){super(t,e,i)}};Xi.prototype.ValueTypeName="string";Xi.prototype.ValueBufferType=Array;Xi.prototype.DefaultInterpolation=uo;Xi.prototype.InterpolantFactoryMethodLinear=void 0;Xi.prototype.InterpolantFactoryMethodSmooth=void 0;var Zl=class extends pn{constructor(t,e,i,s){super(t,e,i,s)}};Zl.prototype.ValueTypeName="vector";var Jl=class{constructor(t,e,i){let s=this,r=!1,o=0,a=0,c,l=[];this.onStart=void 0,this.onLoad=t,this.onProgress=e,this.onError=i,this._abortController=null,this.itemStart=function(h){a++,r===!1&&s.onStart!==void 0&&s.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,s.onProgress!==void 0&&s.onProgress(h,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(h){s.onError!==void 0&&s.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),c?c(h):h},this.setURLModifier=function(h){return c=h,this},this.addHandler=function(h,u){return l.push(h,u),this},this.removeHandler=function(h){let u=l.indexOf(h);return u!==-1&&l.splice(u,2),this},this.getHandler=function(h){for(let u=0,f=l.length;u<f;u+=2){let d=l[u],g=l[u+1];if(d.global&&(d.lastIndex=0),d.test(h))return g}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},qg=new Jl,Kl=class{constructor(t){this.manager=t!==void 0?t:qg,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(t,e){let i=this;return new Promise(function(s,r){i.load(t,s,e,r)})}parse(){}setCrossOrigin(t){return this.crossOrigin=t,this}setWithCredentials(t){return this.withCredentials=t,this}setPath(t){return this.path=t,this}setResourcePath(t){return this.resourcePath=t,this}setRequestHeader(t){return this.requestHeader=t,this}setPriority(t){return this.priority=t,this}setCache(t){return this.cache=t,this}abort(){return this}};Kl.DEFAULT_MATERIAL_NAME="__DEFAULT";var Ro=class extends $e{static registerNode(t){this.prototype._lightNode=t}constructor(t,e=1){super(),this.isLight=!0,this.type="Light",this.color=new zt(t),this.intensity=e}copy(t,e){return super.copy(t,e),this.color.copy(t.color),this.intensity=t.intensity,this}toJSON(t){let e=super.toJSON(t);return e.object.color=this.color.getHex(),e.object.intensity=this.intensity,e}};var Du=new oe,ng=new N,ig=new N,jl=class{constructor(t){this.camera=t,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new Rt(512,512),this.mapType=ln,this.map=null,this.mapPass=null,this.matrix=new oe,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new Vi,this._frameExtents=new Rt(1,1),this._viewportCount=1,this._viewports=[new ne(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(t){let e=this.camera;ng.setFromMatrixPosition(t.matrixWorld),e.position.copy(ng),ig.setFromMatrixPosition(t.target.matrixWorld),e.lookAt(ig),e.updateMatrixWorld(),this._updateMatrix(e,this.matrix,this._frustum)}_updateMatrix(t,e,i,s){Du.multiplyMatrices(t.projectionMatrix,t.matrixWorldInverse),i.setFromProjectionMatrix(Du,t.coordinateSystem,t.reversedDepth);let r=this._frameExtents,o=s?s.z/r.x:1,a=s?s.w/r.y:1,c=s?s.x/r.x:0,l=s?s.y/r.y:0;t.coordinateSystem===xr||t.reversedDepth?e.set(.5*o,0,0,.5*o+c,0,.5*a,0,.5*a+l,0,0,1,0,0,0,0,1):e.set(.5*o,0,0,.5*o+c,0,.5*a,0,.5*a+l,0,0,.5,.5,0,0,0,1),e.multiply(Du)}getViewport(t){return this._viewports[t]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(t){return this.camera=t.camera.clone(),this.intensity=t.intensity,this.bias=t.bias,this.radius=t.radius,this.autoUpdate=t.autoUpdate,this.needsUpdate=t.needsUpdate,this.normalBias=t.normalBias,this.blurSamples=t.blurSamples,this.mapSize.copy(t.mapSize),this.mapType=t.mapType,this.biasNode=t.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let t={};return t.intensity=this.intensity,t.bias=this.bias,t.normalBias=this.normalBias,t.radius=this.radius,t.blurSamples=this.blurSamples,t.mapSize=this.mapSize.toArray(),t.mapType=this.mapType,t.camera=this.camera.toJSON(!1).object,delete t.camera.matrix,t}},ml=new N,gl=new Ne,qn=new N,Po=class extends $e{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new oe,this.projectionMatrix=new oe,this.projectionMatrixInverse=new oe,this.coordinateSystem=bn,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(t,e){return super.copy(t,e),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorld.decompose(ml,gl,qn),qn.x===1&&qn.y===1&&qn.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(ml,gl,qn.set(1,1,1)).invert()}updateWorldMatrix(t,e,i=!1){super.updateWorldMatrix(t,e,i),this.matrixWorld.decompose(ml,gl,qn),qn.x===1&&qn.y===1&&qn.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(ml,gl,qn.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},ki=new N,sg=new Rt,rg=new Rt,je=class extends Po{constructor(t=50,e=1,i=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=i,this.far=s,this.focus=10,this.aspect=e,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){let e=.5*this.getFilmHeight()/t;this.fov=vr*2*Math.atan(e),this.updateProjectionMatrix()}getFocalLength(){let t=Math.tan(mr*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return vr*2*Math.atan(Math.tan(mr*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,e,i){ki.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),e.set(ki.x,ki.y).multiplyScalar(-t/ki.z),ki.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),i.set(ki.x,ki.y).multiplyScalar(-t/ki.z)}getViewSize(t,e){return this.getViewBounds(t,sg,rg),e.subVectors(rg,sg)}setViewOffset(t,e,i,s,r,o){this.aspect=t/e,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=this.near,e=t*Math.tan(mr*.5*this.fov)/this.zoom,i=2*e,s=this.aspect*i,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let c=o.fullWidth,l=o.fullHeight;r+=o.offsetX*s/c,e-=o.offsetY*i/l,s*=o.width/c,i*=o.height/l}let a=this.filmOffset;a!==0&&(r+=t*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,e,e-i,t,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.fov=this.fov,e.object.zoom=this.zoom,e.object.near=this.near,e.object.far=this.far,e.object.focus=this.focus,e.object.aspect=this.aspect,this.view!==null&&(e.object.view=Object.assign({},this.view)),e.object.filmGauge=this.filmGauge,e.object.filmOffset=this.filmOffset,e}};var Io=class extends Po{constructor(t=-1,e=1,i=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=e,this.top=i,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,e,i,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=(this.right-this.left)/(2*this.zoom),e=(this.top-this.bottom)/(2*this.zoom),i=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=i-t,o=i+t,a=s+e,c=s-e;if(this.view!==null&&this.view.enabled){let l=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=l*this.view.offsetX,o=r+l*this.view.width,a-=h*this.view.offsetY,c=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,c,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.zoom=this.zoom,e.object.left=this.left,e.object.right=this.right,e.object.top=this.top,e.object.bottom=this.bottom,e.object.near=this.near,e.object.far=this.far,this.view!==null&&(e.object.view=Object.assign({},this.view)),e}},zu=class extends jl{constructor(){super(new Io(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},Lo=class extends Ro{constructor(t,e){super(t,e),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy($e.DEFAULT_UP),this.updateMatrix(),this.target=new $e,this.shadow=new zu}dispose(){super.dispose(),this.shadow.dispose()}copy(t){return super.copy(t),this.target=t.target.clone(),this.shadow=t.shadow.clone(),this}toJSON(t){let e=super.toJSON(t);return e.object.shadow=this.shadow.toJSON(),e.object.target=this.target.uuid,e}},No=class extends Ro{constructor(t,e){super(t,e),this.isAmbientLight=!0,this.type="AmbientLight"}};var Do=class extends ue{constructor(){super(),this.isInstancedBufferGeometry=!0,this.type="InstancedBufferGeometry",this.instanceCount=1/0}copy(t){return super.copy(t),this.instanceCount=t.instanceCount,this}toJSON(){let t=super.toJSON();return t.instanceCount=this.instanceCount,t.isInstancedBufferGeometry=!0,t}};var ur=-90,fr=1,Er=class extends $e{constructor(t,e,i){super(),this.type="CubeCamera",this.renderTarget=i,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new je(ur,fr,t,e);s.layers=this.layers,this.add(s);let r=new je(ur,fr,t,e);r.layers=this.layers,this.add(r);let o=new je(ur,fr,t,e);o.layers=this.layers,this.add(o);let a=new je(ur,fr,t,e);a.layers=this.layers,this.add(a);let c=new je(ur,fr,t,e);c.layers=this.layers,this.add(c);let l=new je(ur,fr,t,e);l.layers=this.layers,this.add(l)}updateCoordinateSystem(){let t=this.coordinateSystem,e=this.children.concat(),[i,s,r,o,a,c]=e;for(let l of e)this.remove(l);if(t===bn)i.up.set(0,1,0),i.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),c.up.set(0,1,0),c.lookAt(0,0,-1);else if(t===xr)i.up.set(0,-1,0),i.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),c.up.set(0,-1,0),c.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(let l of e)this.add(l),l.updateMatrixWorld()}update(t,e){this.parent===null&&this.updateMatrixWorld();let{renderTarget:i,activeMipmapLevel:s}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,c,l,h]=this.children,u=t.getRenderTarget(),f=t.getActiveCubeFace(),d=t.getActiveMipmapLevel(),g=t.xr.enabled;t.xr.enabled=!1;let _=i.texture.mipmapsAutoUpdate;i.texture.mipmapsAutoUpdate=!1;let p=!1;t.isWebGLRenderer===!0?p=t.state.buffers.depth.getReversed():p=t.reversedDepthBuffer,t.setRenderTarget(i,0,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,r),t.setRenderTarget(i,1,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,o),t.setRenderTarget(i,2,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,a),t.setRenderTarget(i,3,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,c),t.setRenderTarget(i,4,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,l),i.texture.mipmapsAutoUpdate=_,t.setRenderTarget(i,5,s),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,h),t.setRenderTarget(u,f,d),t.xr.enabled=g,i.texture.needsPMREMUpdate=!0}},Ql=class extends je{constructor(t=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=t,this.perCameraFrustumCulled=!1}};var Mf="\\[\\]\\.:\\/",ob=new RegExp("["+Mf+"]","g"),Sf="[^"+Mf+"]",ab="[^"+Mf.replace("\\.","")+"]",lb=/((?:WC+[\/:])*)/.source.replace("WC",Sf),cb=/(WCOD+)?/.source.replace("WCOD",ab),hb=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",Sf),ub=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",Sf),fb=new RegExp("^"+lb+cb+hb+ub+"$"),db=["material","materials","bones","map"],Vu=class{constructor(t,e,i){let s=i||he.parseTrackName(e);this._targetGroup=t,this._bindings=t.subscribe_(e,s)}getValue(t,e){this.bind();let i=this._targetGroup.nCachedObjects_,s=this._bindings[i];s!==void 0&&s.getValue(t,e)}setValue(t,e){let i=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=i.length;s!==r;++s)i[s].setValue(t,e)}bind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,i=t.length;e!==i;++e)t[e].bind()}unbind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,i=t.length;e!==i;++e)t[e].unbind()}},he=class n{constructor(t,e,i){this.path=e,this.parsedPath=i||n.parseTrackName(e),this.node=n.findNode(t,this.parsedPath.nodeName),this.rootNode=t,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(t,e,i){return t&&t.isAnimationObjectGroup?new n.Composite(t,e,i):new n(t,e,i)}static sanitizeNodeName(t){return t.replace(/\s/g,"_").replace(ob,"")}static parseTrackName(t){let e=fb.exec(t);if(e===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+t);let i={nodeName:e[2],objectName:e[3],objectIndex:e[4],propertyName:e[5],propertyIndex:e[6]},s=i.nodeName&&i.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=i.nodeName.substring(s+1);db.indexOf(r)!==-1&&(i.nodeName=i.nodeName.substring(0,s),i.objectName=r)}if(i.propertyName===null||i.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+t);return i}static findNode(t,e){if(e===void 0||e===""||e==="."||e===-1||e===t.name||e===t.uuid)return t;if(t.skeleton){let i=t.skeleton.getBoneByName(e);if(i!==void 0)return i}if(t.children){let i=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===e||a.uuid===e)return a;let c=i(a.children);if(c)return c}return null},s=i(t.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(t,e){t[e]=this.targetObject[this.propertyName]}_getValue_array(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)t[e++]=i[s]}_getValue_arrayElement(t,e){t[e]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(t,e){this.resolvedProperty.toArray(t,e)}_setValue_direct(t,e){this.targetObject[this.propertyName]=t[e]}_setValue_direct_setNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=t[e++]}_setValue_array_setNeedsUpdate(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=t[e++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=t[e++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(t,e){this.resolvedProperty[this.propertyIndex]=t[e]}_setValue_arrayElement_setNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(t,e){this.resolvedProperty.fromArray(t,e)}_setValue_fromArray_setNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(t,e){this.bind(),this.getValue(t,e)}_setValue_unbound(t,e){this.bind(),this.setValue(t,e)}bind(){let t=this.node,e=this.parsedPath,i=e.objectName,s=e.propertyName,r=e.propertyIndex;if(t||(t=n.findNode(this.rootNode,e.nodeName),this.node=t),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!t){It("PropertyBinding: No target node found for track: "+this.path+".");return}if(i){let l=e.objectIndex;switch(i){case"materials":if(!t.material){Dt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.materials){Dt("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}t=t.material.materials;break;case"bones":if(!t.skeleton){Dt("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}t=t.skeleton.bones;for(let h=0;h<t.length;h++)if(t[h].name===l){l=h;break}break;case"map":if("map"in t){t=t.map;break}if(!t.material){Dt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.map){Dt("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}t=t.material.map;break;default:if(t[i]===void 0){Dt("PropertyBinding: Can not bind to objectName of node undefined.",this);return}t=t[i]}if(l!==void 0){if(t[l]===void 0){Dt("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,t);return}t=t[l]}}let o=t[s];if(o===void 0){let l=e.nodeName;Dt("PropertyBinding: Trying to update property for track: "+l+"."+s+" but it wasn't found.",t);return}let a=this.Versioning.None;this.targetObject=t,t.isMaterial===!0?a=this.Versioning.NeedsUpdate:t.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let c=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!t.geometry){Dt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!t.geometry.morphAttributes){Dt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}t.morphTargetDictionary[r]!==void 0&&(r=t.morphTargetDictionary[r])}c=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(c=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(c=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[c],this.setValue=this.SetterByBindingTypeAndVersioning[c][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};he.Composite=Vu;he.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};he.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};he.prototype.GetterByBindingType=[he.prototype._getValue_direct,he.prototype._getValue_array,he.prototype._getValue_arrayElement,he.prototype._getValue_toArray];he.prototype.SetterByBindingTypeAndVersioning=[[he.prototype._setValue_direct,he.prototype._setValue_direct_setNeedsUpdate,he.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[he.prototype._setValue_array,he.prototype._setValue_array_setNeedsUpdate,he.prototype._setValue_array_setMatrixWorldNeedsUpdate],[he.prototype._setValue_arrayElement,he.prototype._setValue_arrayElement_setNeedsUpdate,he.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[he.prototype._setValue_fromArray,he.prototype._setValue_fromArray_setNeedsUpdate,he.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var gR=new Float32Array(1);var $i=class extends Nl{constructor(t,e,i=1){super(t,e),this.isInstancedInterleavedBuffer=!0,this.meshPerAttribute=i}copy(t){return super.copy(t),this.meshPerAttribute=t.meshPerAttribute,this}clone(t){let e=super.clone(t);return e.meshPerAttribute=this.meshPerAttribute,e}toJSON(t){let e=super.toJSON(t);return e.isInstancedInterleavedBuffer=!0,e.meshPerAttribute=this.meshPerAttribute,e}};var og=new oe,Uo=class{constructor(t,e,i=0,s=1/0){this.ray=new zi(t,e),this.near=i,this.far=s,this.camera=null,this.layers=new Mr,this.params={Mesh:{},Line:{threshold:1},LOD:{},Points:{threshold:1},Sprite:{}}}set(t,e){this.ray.set(t,e)}setFromCamera(t,e){e.isPerspectiveCamera?(this.ray.origin.setFromMatrixPosition(e.matrixWorld),this.ray.direction.set(t.x,t.y,.5).unproject(e).sub(this.ray.origin).normalize(),this.camera=e):e.isOrthographicCamera?(this.ray.origin.set(t.x,t.y,e.projectionMatrix.elements[14]).unproject(e),this.ray.direction.set(0,0,-1).transformDirection(e.matrixWorld),this.camera=e):Dt("Raycaster: Unsupported camera type: "+e.type)}setFromXRController(t){return og.identity().extractRotation(t.matrixWorld),this.ray.origin.setFromMatrixPosition(t.matrixWorld),this.ray.direction.set(0,0,-1).applyMatrix4(og),this}intersectObject(t,e=!0,i=[]){return Gu(t,this,i,e),i.sort(ag),i}intersectObjects(t,e=!0,i=[]){for(let s=0,r=t.length;s<r;s++)Gu(t[s],this,i,e);return i.sort(ag),i}};function ag(n,t){return n.distance-t.distance}function Gu(n,t,e,i){let s=!0;if(n.layers.test(t.layers)&&n.raycast(t,e)===!1&&(s=!1),s===!0&&i===!0){let r=n.children;for(let o=0,a=r.length;o<a;o++)Gu(r[o],t,e,!0)}}var Ar=class{constructor(t=1,e=0,i=0){this.radius=t,this.phi=e,this.theta=i}set(t,e,i){return this.radius=t,this.phi=e,this.theta=i,this}copy(t){return this.radius=t.radius,this.phi=t.phi,this.theta=t.theta,this}makeSafe(){return this.phi=Bt(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(t){return this.setFromCartesianCoords(t.x,t.y,t.z)}setFromCartesianCoords(t,e,i){return this.radius=Math.sqrt(t*t+e*e+i*i),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(t,i),this.phi=Math.acos(Bt(e/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var Hu=class{static{this.prototype.isMatrix2=!0}constructor(t,e,i,s){this.elements=[1,0,0,1],t!==void 0&&this.set(t,e,i,s)}identity(){return this.set(1,0,0,1),this}fromArray(t,e=0){for(let i=0;i<4;i++)this.elements[i]=t[i+e];return this}set(t,e,i,s){let r=this.elements;return r[0]=t,r[2]=e,r[1]=i,r[3]=s,this}};var lg=new N,_l=new N,dr=new N,pr=new N,Uu=new N,pb=new N,mb=new N,Oo=class{constructor(t=new N,e=new N){this.start=t,this.end=e}set(t,e){return this.start.copy(t),this.end.copy(e),this}copy(t){return this.start.copy(t.start),this.end.copy(t.end),this}getCenter(t){return t.addVectors(this.start,this.end).multiplyScalar(.5)}delta(t){return t.subVectors(this.end,this.start)}distanceSq(){return this.start.distanceToSquared(this.end)}distance(){return this.start.distanceTo(this.end)}at(t,e){return this.delta(e).multiplyScalar(t).add(this.start)}closestPointToPointParameter(t,e){lg.subVectors(t,this.start),_l.subVectors(this.end,this.start);let i=_l.dot(_l);if(i===0)return 0;let r=_l.dot(lg)/i;return e&&(r=Bt(r,0,1)),r}closestPointToPoint(t,e,i){let s=this.closestPointToPointParameter(t,e);return this.delta(i).multiplyScalar(s).add(this.start)}distanceSqToLine3(t,e=pb,i=mb){let s=10000000000000001e-32,r,o,a=this.start,c=t.start,l=this.end,h=t.end;dr.subVectors(l,a),pr.subVectors(h,c),Uu.subVectors(a,c);let u=dr.dot(dr),f=pr.dot(pr),d=pr.dot(Uu);if(u<=s&&f<=s)return e.copy(a),i.copy(c),e.distanceToSquared(i);if(u<=s)r=0,o=d/f,o=Bt(o,0,1);else{let g=dr.dot(Uu);if(f<=s)o=0,r=Bt(-g/u,0,1);else{let _=dr.dot(pr),p=u*f-_*_;p!==0?r=Bt((_*d-g*f)/p,0,1):r=0,o=(_*r+d)/f,o<0?(o=0,r=Bt(-g/u,0,1)):o>1&&(o=1,r=Bt((_-g)/u,0,1))}}return e.copy(a).addScaledVector(dr,r),i.copy(c).addScaledVector(pr,o),e.distanceToSquared(i)}applyMatrix4(t){return this.start.applyMatrix4(t),this.end.applyMatrix4(t),this}equals(t){return t.start.equals(this.start)&&t.end.equals(this.end)}clone(){return new this.constructor().copy(this)}};var Fo=class extends Nn{constructor(t,e=null){super(),this.object=t,this.domElement=e,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(t){this.domElement!==null&&this.disconnect(),this.domElement=t}disconnect(){}dispose(){}update(){}};function wf(n,t,e,i){let s=gb(i);switch(e){case cf:return n*t;case uf:return n*t/s.components*s.byteLength;case ac:return n*t/s.components*s.byteLength;case Ji:return n*t*2/s.components*s.byteLength;case lc:return n*t*2/s.components*s.byteLength;case hf:return n*t*3/s.components*s.byteLength;case zn:return n*t*4/s.components*s.byteLength;case cc:return n*t*4/s.components*s.byteLength;case zo:case Vo:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*8;case Go:case Ho:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*16;case uc:case dc:return Math.max(n,16)*Math.max(t,8)/4;case hc:case fc:return Math.max(n,8)*Math.max(t,8)/2;case pc:case mc:case _c:case xc:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*8;case gc:case Wo:case yc:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*16;case vc:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*16;case bc:return Math.floor((n+4)/5)*Math.floor((t+3)/4)*16;case Mc:return Math.floor((n+4)/5)*Math.floor((t+4)/5)*16;case Sc:return Math.floor((n+5)/6)*Math.floor((t+4)/5)*16;case wc:return Math.floor((n+5)/6)*Math.floor((t+5)/6)*16;case Ec:return Math.floor((n+7)/8)*Math.floor((t+4)/5)*16;case Ac:return Math.floor((n+7)/8)*Math.floor((t+5)/6)*16;case Tc:return Math.floor((n+7)/8)*Math.floor((t+7)/8)*16;case Cc:return Math.floor((n+9)/10)*Math.floor((t+4)/5)*16;case Rc:return Math.floor((n+9)/10)*Math.floor((t+5)/6)*16;case Pc:return Math.floor((n+9)/10)*Math.floor((t+7)/8)*16;case Ic:return Math.floor((n+9)/10)*Math.floor((t+9)/10)*16;case Lc:return Math.floor((n+11)/12)*Math.floor((t+9)/10)*16;case Nc:return Math.floor((n+11)/12)*Math.floor((t+11)/12)*16;case Dc:case Uc:case Oc:return Math.ceil(n/4)*Math.ceil(t/4)*16;case Fc:case Bc:return Math.ceil(n/4)*Math.ceil(t/4)*8;case Xo:case kc:return Math.ceil(n/4)*Math.ceil(t/4)*16}throw new Error(`Unable to determine texture byte length for ${e} format.`)}function gb(n){switch(n){case ln:case rf:return{byteLength:1,components:1};case Pr:case of:case kn:return{byteLength:2,components:1};case rc:case oc:return{byteLength:2,components:4};case Fn:case sc:case Bn:return{byteLength:4,components:1};case af:case lf:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${n}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?It("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function m0(){let n=null,t=!1,e=null,i=null;function s(r,o){i=n.requestAnimationFrame(s),e(r,o)}return{start:function(){t!==!0&&e!==null&&n!==null&&(i=n.requestAnimationFrame(s),t=!0)},stop:function(){n!==null&&n.cancelAnimationFrame(i),t=!1},setAnimationLoop:function(r){e=r},setContext:function(r){n=r}}}function xb(n){let t=new WeakMap;function e(a,c){let l=a.array,h=a.usage,u=l.byteLength,f=n.createBuffer();n.bindBuffer(c,f),n.bufferData(c,l,h),a.onUploadCallback();let d;if(l instanceof Float32Array)d=n.FLOAT;else if(typeof Float16Array<"u"&&l instanceof Float16Array)d=n.HALF_FLOAT;else if(l instanceof Uint16Array)a.isFloat16BufferAttribute?d=n.HALF_FLOAT:d=n.UNSIGNED_SHORT;else if(l instanceof Int16Array)d=n.SHORT;else if(l instanceof Uint32Array)d=n.UNSIGNED_INT;else if(l instanceof Int32Array)d=n.INT;else if(l instanceof Int8Array)d=n.BYTE;else if(l instanceof Uint8Array)d=n.UNSIGNED_BYTE;else if(l instanceof Uint8ClampedArray)d=n.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+l);return{buffer:f,type:d,bytesPerElement:l.BYTES_PER_ELEMENT,version:a.version,size:u}}function i(a,c,l){let h=c.array,u=c.updateRanges;if(n.bindBuffer(l,a),u.length===0)n.bufferSubData(l,0,h);else{u.sort((d,g)=>d.start-g.start);let f=0;for(let d=1;d<u.length;d++){let g=u[f],_=u[d];_.start<=g.start+g.count+1?g.count=Math.max(g.count,_.start+_.count-g.start):(++f,u[f]=_)}u.length=f+1;for(let d=0,g=u.length;d<g;d++){let _=u[d];n.bufferSubData(l,_.start*h.BYTES_PER_ELEMENT,h,_.start,_.count)}c.clearUpdateRanges()}c.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),t.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let c=t.get(a);c&&(n.deleteBuffer(c.buffer),t.delete(a))}function o(a,c){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=t.get(a);(!h||h.version<a.version)&&t.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let l=t.get(a);if(l===void 0)t.set(a,e(a,c));else if(l.version<a.version){if(l.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");i(l.buffer,a,c),l.version=a.version}}return{get:s,remove:r,update:o}}var yb=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,vb=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,bb=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,Mb=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,Sb=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,wb=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,Eb=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,Ab=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,Tb=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,Cb=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,Rb=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,Pb=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,Ib=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,Lb=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,Nb=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,Db=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,Ub=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,Ob=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,Fb=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,Bb=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,kb=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,zb=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,Vb=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,Gb=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,Hb=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,Wb=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,Xb=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,$b=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,qb=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,Yb="gl_FragColor = linearToOutputTexel( gl_FragColor );",Zb=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,Jb=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,Kb=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,jb=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,Qb=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,tM=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,eM=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,nM=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,iM=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,sM=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,rM=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,oM=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,aM=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,lM=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,cM=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,hM=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,uM=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,fM=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,dM=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,pM=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,mM=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,gM=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,_M=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,xM=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,yM=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,vM=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,bM=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,MM=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,SM=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,wM=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,EM=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,AM=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,TM=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,CM=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,RM=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,PM=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,IM=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,LM=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,NM=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,DM=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,UM=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,OM=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,FM=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,BM=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,kM=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,zM=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,VM=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,GM=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,HM=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,WM=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,XM=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,$M=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,qM=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,YM=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,ZM=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,JM=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,KM=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,jM=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,QM=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,tS=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,eS=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,nS=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,iS=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,sS=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,rS=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,oS=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,aS=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,lS=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,cS=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,hS=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,uS=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,fS=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,dS=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,pS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,mS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,gS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,_S=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,xS=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,yS=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,vS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,bS=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,MS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,SS=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,wS=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,ES=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,AS=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,TS=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,CS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,RS=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,PS=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,IS=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,LS=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,NS=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,DS=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,US=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,OS=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,FS=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,BS=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,kS=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,zS=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,VS=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,GS=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,HS=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,WS=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,XS=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,$S=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,qS=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,YS=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,ZS=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,JS=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,KS=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,Gt={alphahash_fragment:yb,alphahash_pars_fragment:vb,alphamap_fragment:bb,alphamap_pars_fragment:Mb,alphatest_fragment:Sb,alphatest_pars_fragment:wb,aomap_fragment:Eb,aomap_pars_fragment:Ab,batching_pars_vertex:Tb,batching_vertex:Cb,begin_vertex:Rb,beginnormal_vertex:Pb,bsdfs:Ib,iridescence_fragment:Lb,bumpmap_pars_fragment:Nb,clipping_planes_fragment:Db,clipping_planes_pars_fragment:Ub,clipping_planes_pars_vertex:Ob,clipping_planes_vertex:Fb,color_fragment:Bb,color_pars_fragment:kb,color_pars_vertex:zb,color_vertex:Vb,common:Gb,defaultnormal_vertex:Hb,displacementmap_pars_vertex:Wb,displacementmap_vertex:Xb,emissivemap_fragment:$b,emissivemap_pars_fragment:qb,colorspace_fragment:Yb,colorspace_pars_fragment:Zb,envmap_fragment:Jb,envmap_common_pars_fragment:Kb,envmap_pars_fragment:jb,envmap_pars_vertex:Qb,envmap_physical_pars_fragment:hM,envmap_vertex:tM,fog_vertex:eM,fog_pars_vertex:nM,fog_fragment:iM,fog_pars_fragment:sM,gradientmap_pars_fragment:rM,lightmap_pars_fragment:oM,lights_lambert_fragment:aM,lights_lambert_pars_fragment:lM,lights_pars_begin:cM,lights_toon_fragment:uM,lights_toon_pars_fragment:fM,lights_phong_fragment:dM,lights_phong_pars_fragment:pM,lights_physical_fragment:mM,lights_physical_pars_fragment:gM,lights_fragment_begin:_M,lights_fragment_maps:xM,lights_fragment_end:yM,lightprobes_pars_fragment:vM,logdepthbuf_fragment:bM,logdepthbuf_pars_fragment:MM,logdepthbuf_pars_vertex:SM,logdepthbuf_vertex:wM,map_fragment:EM,map_pars_fragment:AM,map_particle_fragment:TM,map_particle_pars_fragment:CM,metalnessmap_fragment:RM,metalnessmap_pars_fragment:PM,morphinstance_vertex:IM,morphcolor_vertex:LM,morphnormal_vertex:NM,morphtarget_pars_vertex:DM,morphtarget_vertex:UM,normal_fragment_begin:OM,normal_fragment_maps:FM,normal_pars_fragment:BM,normal_pars_vertex:kM,normal_vertex:zM,normalmap_pars_fragment:VM,clearcoat_normal_fragment_begin:GM,clearcoat_normal_fragment_maps:HM,clearcoat_pars_fragment:WM,iridescence_pars_fragment:XM,opaque_fragment:$M,packing:qM,premultiplied_alpha_fragment:YM,project_vertex:ZM,dithering_fragment:JM,dithering_pars_fragment:KM,roughnessmap_fragment:jM,roughnessmap_pars_fragment:QM,shadowmap_pars_fragment:tS,shadowmap_pars_vertex:eS,shadowmap_vertex:nS,shadowmask_pars_fragment:iS,skinbase_vertex:sS,skinning_pars_vertex:rS,skinning_vertex:oS,skinnormal_vertex:aS,specularmap_fragment:lS,specularmap_pars_fragment:cS,tonemapping_fragment:hS,tonemapping_pars_fragment:uS,transmission_fragment:fS,transmission_pars_fragment:dS,uv_pars_fragment:pS,uv_pars_vertex:mS,uv_vertex:gS,worldpos_vertex:_S,background_vert:xS,background_frag:yS,backgroundCube_vert:vS,backgroundCube_frag:bS,cube_vert:MS,cube_frag:SS,depth_vert:wS,depth_frag:ES,distance_vert:AS,distance_frag:TS,equirect_vert:CS,equirect_frag:RS,linedashed_vert:PS,linedashed_frag:IS,meshbasic_vert:LS,meshbasic_frag:NS,meshlambert_vert:DS,meshlambert_frag:US,meshmatcap_vert:OS,meshmatcap_frag:FS,meshnormal_vert:BS,meshnormal_frag:kS,meshphong_vert:zS,meshphong_frag:VS,meshphysical_vert:GS,meshphysical_frag:HS,meshtoon_vert:WS,meshtoon_frag:XS,points_vert:$S,points_frag:qS,shadow_vert:YS,shadow_frag:ZS,sprite_vert:JS,sprite_frag:KS},_t={common:{diffuse:{value:new zt(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new Ut},alphaMap:{value:null},alphaMapTransform:{value:new Ut},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new Ut}},envmap:{envMap:{value:null},envMapRotation:{value:new Ut},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new Ut}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new Ut}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new Ut},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new Ut},normalScale:{value:new Rt(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new Ut},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new Ut}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new Ut}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new Ut}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new zt(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new zt(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new Ut},alphaTest:{value:0},uvTransform:{value:new Ut}},sprite:{diffuse:{value:new zt(16777215)},opacity:{value:1},center:{value:new Rt(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new Ut},alphaMap:{value:null},alphaMapTransform:{value:new Ut},alphaTest:{value:0}}},en={basic:{uniforms:qe([_t.common,_t.specularmap,_t.envmap,_t.aomap,_t.lightmap,_t.fog]),vertexShader:Gt.meshbasic_vert,fragmentShader:Gt.meshbasic_frag},lambert:{uniforms:qe([_t.common,_t.specularmap,_t.envmap,_t.aomap,_t.lightmap,_t.emissivemap,_t.bumpmap,_t.normalmap,_t.displacementmap,_t.fog,_t.lights,{emissive:{value:new zt(0)},envMapIntensity:{value:1}}]),vertexShader:Gt.meshlambert_vert,fragmentShader:Gt.meshlambert_frag},phong:{uniforms:qe([_t.common,_t.specularmap,_t.envmap,_t.aomap,_t.lightmap,_t.emissivemap,_t.bumpmap,_t.normalmap,_t.displacementmap,_t.fog,_t.lights,{emissive:{value:new zt(0)},specular:{value:new zt(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:Gt.meshphong_vert,fragmentShader:Gt.meshphong_frag},standard:{uniforms:qe([_t.common,_t.envmap,_t.aomap,_t.lightmap,_t.emissivemap,_t.bumpmap,_t.normalmap,_t.displacementmap,_t.roughnessmap,_t.metalnessmap,_t.fog,_t.lights,{emissive:{value:new zt(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:Gt.meshphysical_vert,fragmentShader:Gt.meshphysical_frag},toon:{uniforms:qe([_t.common,_t.aomap,_t.lightmap,_t.emissivemap,_t.bumpmap,_t.normalmap,_t.displacementmap,_t.gradientmap,_t.fog,_t.lights,{emissive:{value:new zt(0)}}]),vertexShader:Gt.meshtoon_vert,fragmentShader:Gt.meshtoon_frag},matcap:{uniforms:qe([_t.common,_t.bumpmap,_t.normalmap,_t.displacementmap,_t.fog,{matcap:{value:null}}]),vertexShader:Gt.meshmatcap_vert,fragmentShader:Gt.meshmatcap_frag},points:{uniforms:qe([_t.points,_t.fog]),vertexShader:Gt.points_vert,fragmentShader:Gt.points_frag},dashed:{uniforms:qe([_t.common,_t.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:Gt.linedashed_vert,fragmentShader:Gt.linedashed_frag},depth:{uniforms:qe([_t.common,_t.displacementmap]),vertexShader:Gt.depth_vert,fragmentShader:Gt.depth_frag},normal:{uniforms:qe([_t.common,_t.bumpmap,_t.normalmap,_t.displacementmap,{opacity:{value:1}}]),vertexShader:Gt.meshnormal_vert,fragmentShader:Gt.meshnormal_frag},sprite:{uniforms:qe([_t.sprite,_t.fog]),vertexShader:Gt.sprite_vert,fragmentShader:Gt.sprite_frag},background:{uniforms:{uvTransform:{value:new Ut},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:Gt.background_vert,fragmentShader:Gt.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new Ut}},vertexShader:Gt.backgroundCube_vert,fragmentShader:Gt.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:Gt.cube_vert,fragmentShader:Gt.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:Gt.equirect_vert,fragmentShader:Gt.equirect_frag},distance:{uniforms:qe([_t.common,_t.displacementmap,{referencePosition:{value:new N},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:Gt.distance_vert,fragmentShader:Gt.distance_frag},shadow:{uniforms:qe([_t.lights,_t.fog,{color:{value:new zt(0)},opacity:{value:1}}]),vertexShader:Gt.shadow_vert,fragmentShader:Gt.shadow_frag}};en.physical={uniforms:qe([en.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new Ut},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new Ut},clearcoatNormalScale:{value:new Rt(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new Ut},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new Ut},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new Ut},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new Ut},sheen:{value:0},sheenColor:{value:new zt(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new Ut},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new Ut},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new Ut},transmissionSamplerSize:{value:new Rt},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new Ut},attenuationDistance:{value:0},attenuationColor:{value:new zt(0)},specularColor:{value:new zt(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new Ut},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new Ut},anisotropyVector:{value:new Rt},anisotropyMap:{value:null},anisotropyMapTransform:{value:new Ut}}]),vertexShader:Gt.meshphysical_vert,fragmentShader:Gt.meshphysical_frag};var Gc={r:0,b:0,g:0},jS=new oe,g0=new Ut;g0.set(-1,0,0,0,1,0,0,0,1);function QS(n,t,e,i,s,r){let o=new zt(0),a=s===!0?0:1,c,l,h=null,u=0,f=null;function d(y){let S=y.isScene===!0?y.background:null;if(S&&S.isTexture){let v=y.backgroundBlurriness>0;S=t.get(S,v)}return S}function g(y){let S=!1,v=d(y);v===null?p(o,a):v&&v.isColor&&(p(v,1),S=!0);let A=n.xr.getEnvironmentBlendMode();A==="additive"?e.buffers.color.setClear(0,0,0,1,r):A==="alpha-blend"&&e.buffers.color.setClear(0,0,0,0,r),(n.autoClear||S)&&(e.buffers.depth.setTest(!0),e.buffers.depth.setMask(!0),e.buffers.color.setMask(!0),n.clear(n.autoClearColor,n.autoClearDepth,n.autoClearStencil))}function _(y,S){let v=d(S);v&&v.isCubeTexture?(l===void 0&&(l=new _e(new Si(1,1,1),new Mn({name:"BackgroundCubeMaterial",uniforms:Ps(en.backgroundCube.uniforms),vertexShader:en.backgroundCube.vertexShader,fragmentShader:en.backgroundCube.fragmentShader,side:De,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),l.geometry.deleteAttribute("uv"),l.onBeforeRender=function(A,E,x){this.matrixWorld.copyPosition(x.matrixWorld)},Object.defineProperty(l.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),i.update(l)),l.material.uniforms.envMap.value=v,l.material.uniforms.backgroundBlurriness.value=S.backgroundBlurriness,l.material.uniforms.backgroundIntensity.value=S.backgroundIntensity,l.material.uniforms.backgroundRotation.value.setFromMatrix4(jS.makeRotationFromEuler(S.backgroundRotation)).transpose(),v.isRenderTargetTexture===!1&&l.material.uniforms.backgroundRotation.value.premultiply(g0),l.material.toneMapped=Yt.getTransfer(v.colorSpace)!==ee,(h!==v||u!==v.version||f!==n.toneMapping)&&(l.material.needsUpdate=!0,h=v,u=v.version,f=n.toneMapping),l.layers.enableAll(),y.unshift(l,l.geometry,l.material,0,0,null)):v&&v.isTexture&&(c===void 0&&(c=new _e(new Ms(2,2),new Mn({name:"BackgroundMaterial",uniforms:Ps(en.background.uniforms),vertexShader:en.background.vertexShader,fragmentShader:en.background.fragmentShader,side:Zi,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),Object.defineProperty(c.material,"map",{get:function(){return this.uniforms.t2D.value}}),i.update(c)),c.material.uniforms.t2D.value=v,c.material.uniforms.backgroundIntensity.value=S.backgroundIntensity,c.material.toneMapped=Yt.getTransfer(v.colorSpace)!==ee,v.matrixAutoUpdate===!0&&v.updateMatrix(),c.material.uniforms.uvTransform.value.copy(v.matrix),(h!==v||u!==v.version||f!==n.toneMapping)&&(c.material.needsUpdate=!0,h=v,u=v.version,f=n.toneMapping),c.layers.enableAll(),y.unshift(c,c.geometry,c.material,0,0,null))}function p(y,S){y.getRGB(Gc,bf(n)),e.buffers.color.setClear(Gc.r,Gc.g,Gc.b,S,r)}function m(){l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0),c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0)}return{getClearColor:function(){return o},setClearColor:function(y,S=1){o.set(y),a=S,p(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(y){a=y,p(o,a)},render:g,addToRenderList:_,dispose:m}}function tw(n,t){let e=n.getParameter(n.MAX_VERTEX_ATTRIBS),i={},s=f(null),r=s,o=!1;function a(L,I,B,R,W){let q=!1,H=u(L,R,B,I);r!==H&&(r=H,l(r.object)),q=d(L,R,B,W),q&&g(L,R,B,W),W!==null&&t.update(W,n.ELEMENT_ARRAY_BUFFER),(q||o)&&(o=!1,v(L,I,B,R),W!==null&&n.bindBuffer(n.ELEMENT_ARRAY_BUFFER,t.get(W).buffer))}function c(){return n.createVertexArray()}function l(L){return n.bindVertexArray(L)}function h(L){return n.deleteVertexArray(L)}function u(L,I,B,R){let W=R.wireframe===!0,q=i[I.id];q===void 0&&(q={},i[I.id]=q);let H=L.isInstancedMesh===!0?L.id:0,K=q[H];K===void 0&&(K={},q[H]=K);let X=K[B.id];X===void 0&&(X={},K[B.id]=X);let Y=X[W];return Y===void 0&&(Y=f(c()),X[W]=Y),Y}function f(L){let I=[],B=[],R=[];for(let W=0;W<e;W++)I[W]=0,B[W]=0,R[W]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:I,enabledAttributes:B,attributeDivisors:R,object:L,attributes:{},index:null}}function d(L,I,B,R){let W=r.attributes,q=I.attributes,H=0,K=B.getAttributes();for(let X in K)if(K[X].location>=0){let rt=W[X],Z=q[X];if(Z===void 0&&(X==="instanceMatrix"&&L.instanceMatrix&&(Z=L.instanceMatrix),X==="instanceColor"&&L.instanceColor&&(Z=L.instanceColor)),rt===void 0||rt.attribute!==Z||Z&&rt.data!==Z.data)return!0;H++}return r.attributesNum!==H||r.index!==R}function g(L,I,B,R){let W={},q=I.attributes,H=0,K=B.getAttributes();for(let X in K)if(K[X].location>=0){let rt=q[X];rt===void 0&&(X==="instanceMatrix"&&L.instanceMatrix&&(rt=L.instanceMatrix),X==="instanceColor"&&L.instanceColor&&(rt=L.instanceColor));let Z={};Z.attribute=rt,rt&&rt.data&&(Z.data=rt.data),W[X]=Z,H++}r.attributes=W,r.attributesNum=H,r.index=R}function _(){let L=r.newAttributes;for(let I=0,B=L.length;I<B;I++)L[I]=0}function p(L){m(L,0)}function m(L,I){let B=r.newAttributes,R=r.enabledAttributes,W=r.attributeDivisors;B[L]=1,R[L]===0&&(n.enableVertexAttribArray(L),R[L]=1),W[L]!==I&&(n.vertexAttribDivisor(L,I),W[L]=I)}function y(){let L=r.newAttributes,I=r.enabledAttributes;for(let B=0,R=I.length;B<R;B++)I[B]!==L[B]&&(n.disableVertexAttribArray(B),I[B]=0)}function S(L,I,B,R,W,q,H){H===!0?n.vertexAttribIPointer(L,I,B,W,q):n.vertexAttribPointer(L,I,B,R,W,q)}function v(L,I,B,R){_();let W=R.attributes,q=B.getAttributes(),H=I.defaultAttributeValues;for(let K in q){let X=q[K];if(X.location>=0){let Y=W[K];if(Y===void 0&&(K==="instanceMatrix"&&L.instanceMatrix&&(Y=L.instanceMatrix),K==="instanceColor"&&L.instanceColor&&(Y=L.instanceColor)),Y!==void 0){let rt=Y.normalized,Z=Y.itemSize,ot=t.get(Y);if(ot===void 0)continue;let z=ot.buffer,it=ot.type,F=ot.bytesPerElement,et=it===n.INT||it===n.UNSIGNED_INT||Y.gpuType===sc;if(Y.isInterleavedBufferAttribute){let st=Y.data,Mt=st.isInterleavedBuffer===!0?st.stride:st.itemSize,Wt=Y.offset;if(st.isInstancedInterleavedBuffer||st.isInstancedBufferAttribute){for(let yt=0;yt<X.locationSize;yt++)m(X.location+yt,st.meshPerAttribute);L.isInstancedMesh!==!0&&R._maxInstanceCount===void 0&&(R._maxInstanceCount=st.meshPerAttribute*st.count)}else for(let yt=0;yt<X.locationSize;yt++)p(X.location+yt);n.bindBuffer(n.ARRAY_BUFFER,z);for(let yt=0;yt<X.locationSize;yt++)S(X.location+yt,Z/X.locationSize,it,rt,Mt*F,(Wt+Z/X.locationSize*yt)*F,et)}else{if(Y.isInstancedBufferAttribute){for(let st=0;st<X.locationSize;st++)m(X.location+st,Y.meshPerAttribute);L.isInstancedMesh!==!0&&R._maxInstanceCount===void 0&&(R._maxInstanceCount=Y.meshPerAttribute*Y.count)}else for(let st=0;st<X.locationSize;st++)p(X.location+st);n.bindBuffer(n.ARRAY_BUFFER,z);for(let st=0;st<X.locationSize;st++)S(X.location+st,Z/X.locationSize,it,rt,Z*F,Z/X.locationSize*st*F,et)}}else if(H!==void 0){let rt=H[K];if(rt!==void 0)switch(rt.length){case 2:n.vertexAttrib2fv(X.location,rt);break;case 3:n.vertexAttrib3fv(X.location,rt);break;case 4:n.vertexAttrib4fv(X.location,rt);break;default:n.vertexAttrib1fv(X.location,rt)}}}}y()}function A(){U();for(let L in i){let I=i[L];for(let B in I){let R=I[B];for(let W in R){let q=R[W];for(let H in q)h(q[H].object),delete q[H];delete R[W]}}delete i[L]}}function E(L){if(i[L.id]===void 0)return;let I=i[L.id];for(let B in I){let R=I[B];for(let W in R){let q=R[W];for(let H in q)h(q[H].object),delete q[H];delete R[W]}}delete i[L.id]}function x(L){for(let I in i){let B=i[I];for(let R in B){let W=B[R];if(W[L.id]===void 0)continue;let q=W[L.id];for(let H in q)h(q[H].object),delete q[H];delete W[L.id]}}}function w(L){for(let I in i){let B=i[I],R=L.isInstancedMesh===!0?L.id:0,W=B[R];if(W!==void 0){for(let q in W){let H=W[q];for(let K in H)h(H[K].object),delete H[K];delete W[q]}delete B[R],Object.keys(B).length===0&&delete i[I]}}}function U(){C(),o=!0,r!==s&&(r=s,l(r.object))}function C(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:U,resetDefaultState:C,dispose:A,releaseStatesOfGeometry:E,releaseStatesOfObject:w,releaseStatesOfProgram:x,initAttributes:_,enableAttribute:p,disableUnusedAttributes:y}}function ew(n,t,e){let i;function s(c){i=c}function r(c,l){n.drawArrays(i,c,l),e.update(l,i,1)}function o(c,l,h){h!==0&&(n.drawArraysInstanced(i,c,l,h),e.update(l,i,h))}function a(c,l,h){if(h===0)return;t.get("WEBGL_multi_draw").multiDrawArraysWEBGL(i,c,0,l,0,h);let f=0;for(let d=0;d<h;d++)f+=l[d];e.update(f,i,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function nw(n,t,e,i){let s;function r(){if(s!==void 0)return s;if(t.has("EXT_texture_filter_anisotropic")===!0){let x=t.get("EXT_texture_filter_anisotropic");s=n.getParameter(x.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(x){return!(x!==zn&&i.convert(x)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(x){let w=x===kn&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(x!==ln&&x!==Bn&&!w&&i.convert(x)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_TYPE))}function c(x){if(x==="highp"){if(n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.HIGH_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.HIGH_FLOAT).precision>0)return"highp";x="mediump"}return x==="mediump"&&n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.MEDIUM_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let l=e.precision!==void 0?e.precision:"highp",h=c(l);h!==l&&(It("WebGLRenderer:",l,"not supported, using",h,"instead."),l=h);let u=e.reversedDepthBuffer===!0&&t.has("EXT_clip_control"),f=e.logarithmicDepthBuffer===!0&&u===!1;e.reversedDepthBuffer===!0&&u===!1&&It("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),e.logarithmicDepthBuffer===!0&&u===!0&&It("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let d=n.getParameter(n.MAX_TEXTURE_IMAGE_UNITS),g=n.getParameter(n.MAX_VERTEX_TEXTURE_IMAGE_UNITS),_=n.getParameter(n.MAX_TEXTURE_SIZE),p=n.getParameter(n.MAX_CUBE_MAP_TEXTURE_SIZE),m=n.getParameter(n.MAX_VERTEX_ATTRIBS),y=n.getParameter(n.MAX_VERTEX_UNIFORM_VECTORS),S=n.getParameter(n.MAX_VARYING_VECTORS),v=n.getParameter(n.MAX_FRAGMENT_UNIFORM_VECTORS),A=n.getParameter(n.MAX_SAMPLES),E=n.getParameter(n.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:c,textureFormatReadable:o,textureTypeReadable:a,precision:l,logarithmicDepthBuffer:f,reversedDepthBuffer:u,maxTextures:d,maxVertexTextures:g,maxTextureSize:_,maxCubemapSize:p,maxAttributes:m,maxVertexUniforms:y,maxVaryings:S,maxFragmentUniforms:v,maxSamples:A,samples:E}}function iw(n){let t=this,e=null,i=0,s=!1,r=!1,o=new Ke,a=new Ut,c={value:null,needsUpdate:!1};this.uniform=c,this.numPlanes=0,this.numIntersection=0,this.init=function(u,f){let d=u.length!==0||f||i!==0||s;return s=f,i=u.length,d},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,f){e=h(u,f,0)},this.setState=function(u,f,d){let g=u.clippingPlanes,_=u.clipIntersection,p=u.clipShadows,m=n.get(u);if(!s||g===null||g.length===0||r&&!p)r?h(null):l();else{let y=r?0:i,S=y*4,v=m.clippingState||null;c.value=v,v=h(g,f,S,d);for(let A=0;A!==S;++A)v[A]=e[A];m.clippingState=v,this.numIntersection=_?this.numPlanes:0,this.numPlanes+=y}};function l(){c.value!==e&&(c.value=e,c.needsUpdate=i>0),t.numPlanes=i,t.numIntersection=0}function h(u,f,d,g){let _=u!==null?u.length:0,p=null;if(_!==0){if(p=c.value,g!==!0||p===null){let m=d+_*4,y=f.matrixWorldInverse;a.getNormalMatrix(y),(p===null||p.length<m)&&(p=new Float32Array(m));for(let S=0,v=d;S!==_;++S,v+=4)o.copy(u[S]).applyMatrix4(y,a),o.normal.toArray(p,v),p[v+3]=o.constant}c.value=p,c.needsUpdate=!0}return t.numPlanes=_,t.numIntersection=0,p}}var Jo=class extends fn{constructor(t=1,e={}){super(t,t,e),this.isWebGLCubeRenderTarget=!0;let i={width:t,height:t,depth:1},s=[i,i,i,i,i,i];this.texture=new bo(s),this._setTextureOptions(e),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(t,e){this.texture.type=e.type,this.texture.colorSpace=e.colorSpace,this.texture.generateMipmaps=e.generateMipmaps,this.texture.minFilter=e.minFilter,this.texture.magFilter=e.magFilter;let i={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new Si(5,5,5),r=new Mn({name:"CubemapFromEquirect",uniforms:Ps(i.uniforms),vertexShader:i.vertexShader,fragmentShader:i.fragmentShader,side:De,blending:As});r.uniforms.tEquirect.value=e;let o=new _e(s,r),a=e.minFilter;return e.minFilter===wi&&(e.minFilter=Qe),new Er(1,10,this).update(t,o),e.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(t,e=!0,i=!0,s=!0){let r=t.getRenderTarget();for(let o=0;o<6;o++)t.setRenderTarget(this,o),t.clear(e,i,s);t.setRenderTarget(r)}},Yg=256,sw=3,rw=20,_0=256,x0=16,ow=3,aw=new N,lw=new zt,Wc=class n{constructor(t){this._renderer=t,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new Er(1,10,null),this._boxMesh=new _e(new Si(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(t,e=0,i=.1,s=100,r={}){let{size:o=256,position:a=aw}=r,c=this._renderer;this._setSize(o);let l=this._allocateTarget(),h=this._getSourceTarget(!0);e>0&&(h.texture.mipmapsAutoUpdate=!1);let u=c.autoClear,f=c.autoClearColor,d=c.autoClearDepth,g=c.autoClearStencil,_=t.background;c.autoClear=!0,c.autoClearColor=!0,c.autoClearDepth=!0,c.autoClearStencil=!0,_===null&&(t.background=c.getClearColor(lw));let p=new Er(i,s,h);return p.position.copy(a),p.update(c,t),c.autoClear=u,c.autoClearColor=f,c.autoClearDepth=d,c.autoClearStencil=g,t.background=_,e>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(l,e)),this._applyPMREM(l),l}fromEquirectangular(t,e=null){return this._fromTexture(t,e)}fromCubemap(t,e=null){return this._fromTexture(t,e)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=Kg(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=Jg(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(t,e){return e>0?1-Math.sqrt(1-t/e):0}_setSize(t){this._cubeSize=Math.max(Yg,xf(t))}_fromTexture(t,e){t.mapping===Cs||t.mapping===Rr?this._setSize(t.image.length===0?Yg:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4);let i=e||this._allocateTarget();return this._textureToCubemap(t),this._applyPMREM(i),i}_allocateTarget(){let t=this._cubeSize,e=Zg(t,!1,!1),i=Math.log2(t)-sw;for(let s=0;s<=i;s++)e.texture.mipmaps.push({width:t>>s,height:t>>s});return e.texture.name="PMREM",e.texture.isPMREMTexture=!0,e}_getSourceTarget(t=!1){let e=this._cubeSize,i=this._sourceTarget;return(i===null||i.width!==e||t&&i.depthBuffer===!1)&&(i!==null&&i.dispose(),this._sourceTarget=Zg(e,!0,t)),this._sourceTarget}_compileMaterial(t){this._boxMesh.material=t,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(t,e,i){let s=this._boxMesh,r=this._cubeCamera;s.material=i,r.renderTarget=t,r.activeMipmapLevel=e;let o=t.width>>e;t.viewport.set(0,0,o,o),r.update(this._renderer,s),t.viewport.set(0,0,t.width,t.height)}_textureToCubemap(t){let e;t.mapping===Cs||t.mapping===Rr?(this._cubemapMaterial===null&&(this._cubemapMaterial=Kg()),e=this._cubemapMaterial,e.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=Jg()),e=this._equirectMaterial),e.uniforms.envMap.value=t,this._renderCube(this._getSourceTarget(),0,e)}_applyPMREM(t){this._ggxMaterial===null&&(this._ggxMaterial=cw(),this._integrationMaterial=hw());let e=this._cubeSize,i=t.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(e/x0);for(let o=0;o<=i;o++){let a=n.lodToRoughness(o,i);if(o>i-ow)r.roughness.value=a,this._renderCube(t,o,this._integrationMaterial);else{let c=a>0?Math.log2(e)+.5*Math.log2(6/(_0*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=c,this._renderCube(t,o,this._ggxMaterial)}}}_blur(t,e){this._blurMaterial===null&&(this._blurMaterial=uw());let i=this._blurMaterial,s=i.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(e,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(t,0,i),s.envMap.value=t.texture,this._renderCube(r,0,i)}};function Zg(n,t,e){return new Jo(n,{minFilter:wi,generateMipmaps:t,type:kn,colorSpace:fo,depthBuffer:e})}function Ko(n,t,e){return new Mn({name:n,uniforms:t,vertexShader:Gt.cube_vert,fragmentShader:e,side:De,blending:As,depthTest:!1,depthWrite:!1})}function cw(){return Ko("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${_0}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function hw(){return Ko("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:x0}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function uw(){return Ko("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${rw}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function Jg(){return Ko("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function Kg(){return Ko("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function fw(n){let t=new WeakMap,e=new WeakMap,i=null;function s(f,d=!1){return f==null?null:d?o(f):r(f)}function r(f){if(f&&f.isTexture){let d=f.mapping;if(d===ec||d===nc)if(t.has(f)){let g=t.get(f).texture;return a(g,f.mapping)}else{let g=f.image;if(g&&g.height>0){let _=new Jo(g.height);return _.fromEquirectangularTexture(n,f),t.set(f,_),f.addEventListener("dispose",l),a(_.texture,f.mapping)}else return null}}return f}function o(f){if(f&&f.isTexture&&f.isPMREMTexture!==!0){let d=f.mapping,g=d===ec||d===nc,_=d===Cs||d===Rr;if(g||_){let p=e.get(f),m=p!==void 0?p.texture.pmremVersion:0;if(f.isRenderTargetTexture&&f.pmremVersion!==m)return i===null&&(i=new Wc(n)),p=g?i.fromEquirectangular(f,p):i.fromCubemap(f,p),p.texture.pmremVersion=f.pmremVersion,e.set(f,p),p.texture;if(p!==void 0)return p.texture;{let y=f.image;return g&&y&&y.height>0||_&&y&&c(y)?(i===null&&(i=new Wc(n)),p=g?i.fromEquirectangular(f):i.fromCubemap(f),p.texture.pmremVersion=f.pmremVersion,e.set(f,p),f.addEventListener("dispose",h),p.texture):null}}}return f}function a(f,d){return d===ec?f.mapping=Cs:d===nc&&(f.mapping=Rr),f}function c(f){let d=0,g=6;for(let _=0;_<g;_++)f[_]!==void 0&&d++;return d===g}function l(f){let d=f.target;d.removeEventListener("dispose",l);let g=t.get(d);g!==void 0&&(t.delete(d),g.dispose())}function h(f){let d=f.target;d.removeEventListener("dispose",h);let g=e.get(d);g!==void 0&&(e.delete(d),g.dispose())}function u(){t=new WeakMap,e=new WeakMap,i!==null&&(i.dispose(),i=null)}return{get:s,dispose:u}}function dw(n){let t={};function e(i){if(t[i]!==void 0)return t[i];let s=n.getExtension(i);return t[i]=s,s}return{has:function(i){return e(i)!==null},init:function(){e("EXT_color_buffer_float"),e("WEBGL_clip_cull_distance"),e("OES_texture_float_linear"),e("EXT_color_buffer_half_float"),e("WEBGL_multisampled_render_to_texture"),e("WEBGL_render_shared_exponent")},get:function(i){let s=e(i);return s===null&&co("WebGLRenderer: "+i+" extension not supported."),s}}}function pw(n,t,e,i){let s={},r=new WeakMap,o=new FinalizationRegistry(g=>delete s[g]);function a(g){c(g.target)}function c(g){g.index!==null&&t.remove(g.index);for(let p in g.attributes)t.remove(g.attributes[p]);g.removeEventListener("dispose",a),delete s[g.id],o.unregister(g);let _=r.get(g);_&&(t.remove(_),r.delete(g)),i.releaseStatesOfGeometry(g),g.isInstancedBufferGeometry===!0&&delete g._maxInstanceCount,e.memory.geometries--}function l(g,_){return s[_.id]!==void 0||(_.addEventListener("dispose",a),s[_.id]=new WeakRef(_),o.register(_,_.id,_),e.memory.geometries++),_}function h(g){let _=g.attributes;for(let p in _)t.update(_[p],n.ARRAY_BUFFER)}function u(g){let _=g.index,p=g.attributes.position,m=0;if(p===void 0)return;let y=_!==null?_.array.length:p.array.length/3-1,S=p.count>=65535?vo:yo,v=new S(Math.ceil(y/3)*6,1),A=v.array;if(_!==null){let x=_.array;m=_.version;for(let w=0,U=0;w<y;w+=3){let C=x[w+0],L=x[w+1],I=x[w+2];A[U++]=C,A[U++]=L,A[U++]=L,A[U++]=I,A[U++]=I,A[U++]=C}}else{m=p.version;for(let x=0,w=0;x<y;x+=3){let U=x+0,C=x+1,L=x+2;A[w++]=U,A[w++]=C,A[w++]=C,A[w++]=L,A[w++]=L,A[w++]=U}}v.version=m;let E=r.get(g);E&&t.remove(E),r.set(g,v)}function f(g){let _=r.get(g);if(_){let p=g.index;p!==null&&_.version<p.version&&u(g)}else u(g);return r.get(g)}function d(){for(let g in s){let _=s[g].deref();_!==void 0&&c(_)}}return{get:l,update:h,getWireframeAttribute:f,dispose:d}}function mw(n,t,e){let i;function s(u){i=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function c(u,f){n.drawElements(i,f,r,u*o),e.update(f,i,1)}function l(u,f,d){d!==0&&(n.drawElementsInstanced(i,f,r,u*o,d),e.update(f,i,d))}function h(u,f,d){if(d===0)return;t.get("WEBGL_multi_draw").multiDrawElementsWEBGL(i,f,0,r,u,0,d);let _=0;for(let p=0;p<d;p++)_+=f[p];e.update(_,i,1)}this.setMode=s,this.setIndex=a,this.render=c,this.renderInstances=l,this.renderMultiDraw=h}function gw(n){let t={geometries:0,textures:0},e={frame:0,calls:0,triangles:0,points:0,lines:0};function i(r,o,a){switch(e.calls++,o){case n.TRIANGLES:e.triangles+=a*(r/3);break;case n.LINES:e.lines+=a*(r/2);break;case n.LINE_STRIP:e.lines+=a*(r-1);break;case n.LINE_LOOP:e.lines+=a*r;break;case n.POINTS:e.points+=a*r;break;default:Dt("WebGLInfo: Unknown draw mode:",o);break}}function s(){e.calls=0,e.triangles=0,e.points=0,e.lines=0}return{memory:t,render:e,programs:null,autoReset:!0,reset:s,update:i}}function _w(n,t,e){let i=new WeakMap,s=new ne;function r(o,a,c){let l=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0,f=i.get(a);if(f===void 0||f.count!==u){let U=function(){x.dispose(),i.delete(a),a.removeEventListener("dispose",U)};f!==void 0&&f.texture.dispose();let d=a.morphAttributes.position!==void 0,g=a.morphAttributes.normal!==void 0,_=a.morphAttributes.color!==void 0,p=a.morphAttributes.position||[],m=a.morphAttributes.normal||[],y=a.morphAttributes.color||[],S=0;d===!0&&(S=1),g===!0&&(S=2),_===!0&&(S=3);let v=a.attributes.position.count*S,A=1;v>t.maxTextureSize&&(A=Math.ceil(v/t.maxTextureSize),v=t.maxTextureSize);let E=new Float32Array(v*A*4*u),x=new _o(E,v,A,u);x.type=Bn,x.needsUpdate=!0;let w=S*4;for(let C=0;C<u;C++){let L=p[C],I=m[C],B=y[C],R=v*A*4*C;for(let W=0;W<L.count;W++){let q=W*w;d===!0&&(s.fromBufferAttribute(L,W),E[R+q+0]=s.x,E[R+q+1]=s.y,E[R+q+2]=s.z,E[R+q+3]=0),g===!0&&(s.fromBufferAttribute(I,W),E[R+q+4]=s.x,E[R+q+5]=s.y,E[R+q+6]=s.z,E[R+q+7]=0),_===!0&&(s.fromBufferAttribute(B,W),E[R+q+8]=s.x,E[R+q+9]=s.y,E[R+q+10]=s.z,E[R+q+11]=B.itemSize===4?s.w:1)}}f={count:u,texture:x,size:new Rt(v,A)},i.set(a,f),a.addEventListener("dispose",U)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)c.getUniforms().setValue(n,"morphTexture",o.morphTexture,e);else{let d=0;for(let _=0;_<l.length;_++)d+=l[_];let g=a.morphTargetsRelative?1:1-d;c.getUniforms().setValue(n,"morphTargetBaseInfluence",g),c.getUniforms().setValue(n,"morphTargetInfluences",l)}c.getUniforms().setValue(n,"morphTargetsTexture",f.texture,e),c.getUniforms().setValue(n,"morphTargetsTextureSize",f.size)}return{update:r}}function xw(n,t,e,i,s){let r=new WeakMap;function o(l){let h=s.render.frame,u=l.geometry,f=t.get(l,u);if(r.get(f)!==h&&(t.update(f),r.set(f,h)),l.isInstancedMesh&&(l.hasEventListener("dispose",c)===!1&&l.addEventListener("dispose",c),r.get(l)!==h&&(e.update(l.instanceMatrix,n.ARRAY_BUFFER),l.instanceColor!==null&&e.update(l.instanceColor,n.ARRAY_BUFFER),r.set(l,h))),l.isSkinnedMesh){let d=l.skeleton;r.get(d)!==h&&(d.update(),r.set(d,h))}return f}function a(){r=new WeakMap}function c(l){let h=l.target;h.removeEventListener("dispose",c),i.releaseStatesOfObject(h),e.remove(h.instanceMatrix),h.instanceColor!==null&&e.remove(h.instanceColor)}return{update:o,dispose:a}}var yw={[Ju]:"LINEAR_TONE_MAPPING",[Ku]:"REINHARD_TONE_MAPPING",[ju]:"CINEON_TONE_MAPPING",[Qu]:"ACES_FILMIC_TONE_MAPPING",[ef]:"AGX_TONE_MAPPING",[nf]:"NEUTRAL_TONE_MAPPING",[tf]:"CUSTOM_TONE_MAPPING"};function vw(n,t,e,i,s,r){let o=new fn(t,e,{type:n,depthBuffer:s,stencilBuffer:r,samples:i?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,c=null,l=null,h=new ue;h.setAttribute("position",new Xt([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new Xt([0,2,0,0,2,0],2));let u=new kl({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),f=new _e(h,u),d=new Io(-1,1,1,-1,0,1),g=null,_=null,p=!1,m,y=null,S=[],v=!1;this.setSize=function(A,E){o.setSize(A,E),a!==null&&a.setSize(A,E),c!==null&&c.setSize(A,E);for(let x=0;x<S.length;x++){let w=S[x];w.setSize&&w.setSize(A,E)}},this.setEffects=function(A){S=A,v=S.length>0&&S[0].isRenderPass===!0;let E=o.width,x=o.height;S.length>0&&a===null&&(a=new fn(E,x,{type:kn,depthBuffer:!1,stencilBuffer:!1}),c=new fn(E,x,{type:kn,depthBuffer:!1,stencilBuffer:!1}));let w=s===!0&&S.some(U=>U.needsDepthTexture===!0);w!==(o.depthTexture!==null)&&(w===!0&&l===null&&(l=new Mi(E,x),r===!0&&(l.format=Ei,l.type=Rs)),o.dispose(),o.depthTexture=w?l:null,o.resolveDepthBuffer=w,o.storeMultisampledDepthBuffer=w);for(let U=0;U<S.length;U++){let C=S[U];C.setSize&&C.setSize(E,x),w&&C.needsDepthTexture===!0&&C.setDepthTexture&&C.setDepthTexture(l)}},this.begin=function(A,E){if(p||A.toneMapping===Jn&&S.length===0)return!1;if(y=E,E!==null){let x=E.width,w=E.height;(o.width!==x||o.height!==w)&&this.setSize(x,w)}return v===!1&&A.setRenderTarget(o),m=A.toneMapping,A.toneMapping=Jn,!0},this.hasRenderPass=function(){return v},this.end=function(A,E){A.toneMapping=m,p=!0;let x=o,w=a;for(let U=0;U<S.length;U++){let C=S[U];C.enabled!==!1&&(C.render(A,w,x,E),C.needsSwap!==!1&&(x=w,w=w===a?c:a))}if(g!==A.outputColorSpace||_!==A.toneMapping){g=A.outputColorSpace,_=A.toneMapping,u.defines={},Yt.getTransfer(g)===ee&&(u.defines.SRGB_TRANSFER="");let U=yw[_];U&&(u.defines[U]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=x.texture,A.setRenderTarget(y),A.render(f,d),y=null,p=!1},this.isCompositing=function(){return p},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),c!==null&&c.dispose(),h.dispose(),u.dispose()}}var y0=new tn,v0=new Mi(1,1),b0=new Mo(1),M0=new _o,S0=new Ll,w0=new bo,jg=[],Qg=[],t0=new Float32Array(16),e0=new Float32Array(9),n0=new Float32Array(4);function Lr(n,t,e){let i=n[0];if(i<=0||i>0)return n;let s=t*e,r=jg[s];if(r===void 0&&(r=new Float32Array(s),jg[s]=r),t!==0){i.toArray(r,0);for(let o=1,a=0;o!==t;++o)a+=e,n[o].toArray(r,a)}return r}function Me(n,t){if(n.length!==t.length)return!1;for(let e=0,i=n.length;e<i;e++)if(n[e]!==t[e])return!1;return!0}function Se(n,t){for(let e=0,i=t.length;e<i;e++)n[e]=t[e]}function $c(n,t){let e=Qg[t];e===void 0&&(e=new Int32Array(t),Qg[t]=e);for(let i=0;i!==t;++i)e[i]=n.allocateTextureUnit();return e}function bw(n,t){let e=this.cache;e[0]!==t&&(n.uniform1f(this.addr,t),e[0]=t)}function Mw(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(n.uniform2f(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Me(e,t))return;n.uniform2fv(this.addr,t),Se(e,t)}}function Sw(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(n.uniform3f(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else if(t.r!==void 0)(e[0]!==t.r||e[1]!==t.g||e[2]!==t.b)&&(n.uniform3f(this.addr,t.r,t.g,t.b),e[0]=t.r,e[1]=t.g,e[2]=t.b);else{if(Me(e,t))return;n.uniform3fv(this.addr,t),Se(e,t)}}function ww(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(n.uniform4f(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Me(e,t))return;n.uniform4fv(this.addr,t),Se(e,t)}}function Ew(n,t){let e=this.cache,i=t.elements;if(i===void 0){if(Me(e,t))return;n.uniformMatrix2fv(this.addr,!1,t),Se(e,t)}else{if(Me(e,i))return;n0.set(i),n.uniformMatrix2fv(this.addr,!1,n0),Se(e,i)}}function Aw(n,t){let e=this.cache,i=t.elements;if(i===void 0){if(Me(e,t))return;n.uniformMatrix3fv(this.addr,!1,t),Se(e,t)}else{if(Me(e,i))return;e0.set(i),n.uniformMatrix3fv(this.addr,!1,e0),Se(e,i)}}function Tw(n,t){let e=this.cache,i=t.elements;if(i===void 0){if(Me(e,t))return;n.uniformMatrix4fv(this.addr,!1,t),Se(e,t)}else{if(Me(e,i))return;t0.set(i),n.uniformMatrix4fv(this.addr,!1,t0),Se(e,i)}}function Cw(n,t){let e=this.cache;e[0]!==t&&(n.uniform1i(this.addr,t),e[0]=t)}function Rw(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(n.uniform2i(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Me(e,t))return;n.uniform2iv(this.addr,t),Se(e,t)}}function Pw(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(n.uniform3i(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Me(e,t))return;n.uniform3iv(this.addr,t),Se(e,t)}}function Iw(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(n.uniform4i(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Me(e,t))return;n.uniform4iv(this.addr,t),Se(e,t)}}function Lw(n,t){let e=this.cache;e[0]!==t&&(n.uniform1ui(this.addr,t),e[0]=t)}function Nw(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(n.uniform2ui(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Me(e,t))return;n.uniform2uiv(this.addr,t),Se(e,t)}}function Dw(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(n.uniform3ui(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Me(e,t))return;n.uniform3uiv(this.addr,t),Se(e,t)}}function Uw(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(n.uniform4ui(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Me(e,t))return;n.uniform4uiv(this.addr,t),Se(e,t)}}function qc(n){return n.version===0&&(n.compareFunction=pf,n.needsUpdate=!0),n}function Ow(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_2D_SHADOW?r=qc(v0):r=y0,e.setTexture2D(t||r,s)}function Fw(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),e.setTexture3D(t||S0,s)}function Bw(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_CUBE_SHADOW?r=qc(b0):r=w0,e.setTextureCube(t||r,s)}function kw(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),e.setTexture2DArray(t||M0,s)}function zw(n){switch(n){case 5126:return bw;case 35664:return Mw;case 35665:return Sw;case 35666:return ww;case 35674:return Ew;case 35675:return Aw;case 35676:return Tw;case 5124:case 35670:return Cw;case 35667:case 35671:return Rw;case 35668:case 35672:return Pw;case 35669:case 35673:return Iw;case 5125:return Lw;case 36294:return Nw;case 36295:return Dw;case 36296:return Uw;case 35678:case 36198:case 36298:case 36306:case 35682:return Ow;case 35679:case 36299:case 36307:return Fw;case 35680:case 36300:case 36308:case 36293:return Bw;case 36289:case 36303:case 36311:case 36292:return kw}}function Vw(n,t){n.uniform1fv(this.addr,t)}function Gw(n,t){let e=Lr(t,this.size,2);n.uniform2fv(this.addr,e)}function Hw(n,t){let e=Lr(t,this.size,3);n.uniform3fv(this.addr,e)}function Ww(n,t){let e=Lr(t,this.size,4);n.uniform4fv(this.addr,e)}function Xw(n,t){let e=Lr(t,this.size,4);n.uniformMatrix2fv(this.addr,!1,e)}function $w(n,t){let e=Lr(t,this.size,9);n.uniformMatrix3fv(this.addr,!1,e)}function qw(n,t){let e=Lr(t,this.size,16);n.uniformMatrix4fv(this.addr,!1,e)}function Yw(n,t){n.uniform1iv(this.addr,t)}function Zw(n,t){n.uniform2iv(this.addr,t)}function Jw(n,t){n.uniform3iv(this.addr,t)}function Kw(n,t){n.uniform4iv(this.addr,t)}function jw(n,t){n.uniform1uiv(this.addr,t)}function Qw(n,t){n.uniform2uiv(this.addr,t)}function t1(n,t){n.uniform3uiv(this.addr,t)}function e1(n,t){n.uniform4uiv(this.addr,t)}function n1(n,t,e){let i=this.cache,s=t.length,r=$c(e,s);Me(i,r)||(n.uniform1iv(this.addr,r),Se(i,r));let o;this.type===n.SAMPLER_2D_SHADOW?o=qc(v0):o=y0;for(let a=0;a!==s;++a)e.setTexture2D(t[a]||o,r[a])}function i1(n,t,e){let i=this.cache,s=t.length,r=$c(e,s);Me(i,r)||(n.uniform1iv(this.addr,r),Se(i,r));for(let o=0;o!==s;++o)e.setTexture3D(t[o]||S0,r[o])}function s1(n,t,e){let i=this.cache,s=t.length,r=$c(e,s);Me(i,r)||(n.uniform1iv(this.addr,r),Se(i,r));let o;this.type===n.SAMPLER_CUBE_SHADOW?o=qc(b0):o=w0;for(let a=0;a!==s;++a)e.setTextureCube(t[a]||o,r[a])}function r1(n,t,e){let i=this.cache,s=t.length,r=$c(e,s);Me(i,r)||(n.uniform1iv(this.addr,r),Se(i,r));for(let o=0;o!==s;++o)e.setTexture2DArray(t[o]||M0,r[o])}function o1(n){switch(n){case 5126:return Vw;case 35664:return Gw;case 35665:return Hw;case 35666:return Ww;case 35674:return Xw;case 35675:return $w;case 35676:return qw;case 5124:case 35670:return Yw;case 35667:case 35671:return Zw;case 35668:case 35672:return Jw;case 35669:case 35673:return Kw;case 5125:return jw;case 36294:return Qw;case 36295:return t1;case 36296:return e1;case 35678:case 36198:case 36298:case 36306:case 35682:return n1;case 35679:case 36299:case 36307:return i1;case 35680:case 36300:case 36308:case 36293:return s1;case 36289:case 36303:case 36311:case 36292:return r1}}var Tf=class{constructor(t,e,i){this.id=t,this.addr=i,this.cache=[],this.type=e.type,this.setValue=zw(e.type)}},Cf=class{constructor(t,e,i){this.id=t,this.addr=i,this.cache=[],this.type=e.type,this.size=e.size,this.setValue=o1(e.type)}},Rf=class{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,e,i){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(t,e[a.id],i)}}},Ef=/(\w+)(\])?(\[|\.)?/g;function i0(n,t){n.seq.push(t),n.map[t.id]=t}function a1(n,t,e){let i=n.name,s=i.length;for(Ef.lastIndex=0;;){let r=Ef.exec(i),o=Ef.lastIndex,a=r[1],c=r[2]==="]",l=r[3];if(c&&(a=a|0),l===void 0||l==="["&&o+2===s){i0(e,l===void 0?new Tf(a,n,t):new Cf(a,n,t));break}else{let u=e.map[a];u===void 0&&(u=new Rf(a),i0(e,u)),e=u}}}var Ir=class{constructor(t,e){this.seq=[],this.map={};let i=t.getProgramParameter(e,t.ACTIVE_UNIFORMS);for(let o=0;o<i;++o){let a=t.getActiveUniform(e,o),c=t.getUniformLocation(e,a.name);a1(a,c,this)}let s=[],r=[];for(let o of this.seq)o.type===t.SAMPLER_2D_SHADOW||o.type===t.SAMPLER_CUBE_SHADOW||o.type===t.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(t,e,i,s){let r=this.map[e];r!==void 0&&r.setValue(t,i,s)}setOptional(t,e,i){let s=e[i];s!==void 0&&this.setValue(t,i,s)}static upload(t,e,i,s){for(let r=0,o=e.length;r!==o;++r){let a=e[r],c=i[a.id];c.needsUpdate!==!1&&a.setValue(t,c.value,s)}}static seqWithValue(t,e){let i=[];for(let s=0,r=t.length;s!==r;++s){let o=t[s];o.id in e&&i.push(o)}return i}};function s0(n,t,e){let i=n.createShader(t);return n.shaderSource(i,e),n.compileShader(i),i}var l1=37297,c1=0;function h1(n,t){let e=n.split(`
`),i=[],s=Math.max(t-6,0),r=Math.min(t+6,e.length);for(let o=s;o<r;o++){let a=o+1;i.push(`${a===t?">":" "} ${a}: ${e[o]}`)}return i.join(`
`)}var r0=new Ut;function u1(n){Yt._getMatrix(r0,Yt.workingColorSpace,n);let t=`mat3( ${r0.elements.map(e=>e.toFixed(4))} )`;switch(Yt.getTransfer(n)){case po:return[t,"LinearTransferOETF"];case ee:return[t,"sRGBTransferOETF"];default:return It("WebGLProgram: Unsupported color space: ",n),[t,"LinearTransferOETF"]}}function o0(n,t,e){let i=n.getShaderParameter(t,n.COMPILE_STATUS),r=(n.getShaderInfoLog(t)||"").trim();if(i&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return e.toUpperCase()+`

`+r+`

`+h1(n.getShaderSource(t),a)}else return r}function f1(n,t){let e=u1(t);return[`vec4 ${n}( vec4 value ) {`,`	return ${e[1]}( vec4( ${e[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var d1={[Ju]:"Linear",[Ku]:"Reinhard",[ju]:"Cineon",[Qu]:"ACESFilmic",[ef]:"AgX",[nf]:"Neutral",[tf]:"Custom"};function p1(n,t){let e=d1[t];return e===void 0?(It("WebGLProgram: Unsupported toneMapping:",t),"vec3 "+n+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+n+"( vec3 color ) { return "+e+"ToneMapping( color ); }"}var Hc=new N;function m1(){Yt.getLuminanceCoefficients(Hc);let n=Hc.x.toFixed(4),t=Hc.y.toFixed(4),e=Hc.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${n}, ${t}, ${e} );`,"	return dot( weights, rgb );","}"].join(`
`)}function g1(n){return[n.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",n.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(Zo).join(`
`)}function _1(n){let t=[];for(let e in n){let i=n[e];i!==!1&&t.push("#define "+e+" "+i)}return t.join(`
`)}function x1(n,t){let e={},i=n.getProgramParameter(t,n.ACTIVE_ATTRIBUTES);for(let s=0;s<i;s++){let r=n.getActiveAttrib(t,s),o=r.name,a=1;r.type===n.FLOAT_MAT2&&(a=2),r.type===n.FLOAT_MAT3&&(a=3),r.type===n.FLOAT_MAT4&&(a=4),e[o]={type:r.type,location:n.getAttribLocation(t,o),locationSize:a}}return e}function Zo(n){return n!==""}function a0(n,t){let e=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return n.replace(/NUM_SUN_LIGHTS/g,t.numSunLights).replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,e).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,t.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,t.numLightProbeGrids)}function l0(n,t){return n.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}var y1=/^[ \t]*#include +<([\w\d./]+)>/gm;function Pf(n){return n.replace(y1,v1)}function v1(n,t){let e=Gt[t];if(e===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+t+">");return Pf(e)}var b1=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function c0(n){return n.replace(b1,M1)}function M1(n,t,e,i){let s="";for(let r=parseInt(t);r<parseInt(e);r++)s+=i.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function h0(n){let t=`precision ${n.precision} float;
	precision ${n.precision} int;
	precision ${n.precision} sampler2D;
	precision ${n.precision} samplerCube;
	precision ${n.precision} sampler3D;
	precision ${n.precision} sampler2DArray;
	precision ${n.precision} sampler2DShadow;
	precision ${n.precision} samplerCubeShadow;
	precision ${n.precision} sampler2DArrayShadow;
	precision ${n.precision} isampler2D;
	precision ${n.precision} isampler3D;
	precision ${n.precision} isamplerCube;
	precision ${n.precision} isampler2DArray;
	precision ${n.precision} usampler2D;
	precision ${n.precision} usampler3D;
	precision ${n.precision} usamplerCube;
	precision ${n.precision} usampler2DArray;
	`;return n.precision==="highp"?t+=`
#define HIGH_PRECISION`:n.precision==="mediump"?t+=`
#define MEDIUM_PRECISION`:n.precision==="lowp"&&(t+=`
#define LOW_PRECISION`),t}var S1={[Bo]:"SHADOWMAP_TYPE_PCF",[Tr]:"SHADOWMAP_TYPE_VSM"};function w1(n){return S1[n.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var E1={[Rr]:"ENVMAP_MODE_REFRACTION"};function A1(n){return n.envMap===!1?"ENVMAP_MODE_REFLECTION":E1[n.envMapMode]||"ENVMAP_MODE_REFLECTION"}var T1={[tc]:"ENVMAP_BLENDING_MULTIPLY",[Pg]:"ENVMAP_BLENDING_MIX",[Ig]:"ENVMAP_BLENDING_ADD"};function C1(n){return n.envMap===!1?"ENVMAP_BLENDING_NONE":T1[n.combine]||"ENVMAP_BLENDING_NONE"}function R1(n,t,e,i){let s=n.getContext(),r=e.defines,o=e.vertexShader,a=e.fragmentShader,c=w1(e),l=e.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=A1(e),u=C1(e),f=g1(e),d=_1(r),g=s.createProgram(),_,p,m=e.glslVersion?"#version "+e.glslVersion+`
`:"";e.isRawShaderMaterial?(_=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d].filter(Zo).join(`
`),_.length>0&&(_+=`
`),p=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d].filter(Zo).join(`
`),p.length>0&&(p+=`
`)):(_=[h0(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d,e.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",e.batching?"#define USE_BATCHING":"",e.batchingColor?"#define USE_BATCHING_COLOR":"",e.instancing?"#define USE_INSTANCING":"",e.instancingColor?"#define USE_INSTANCING_COLOR":"",e.instancingMorph?"#define USE_INSTANCING_MORPH":"",e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.map?"#define USE_MAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+h:"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.displacementMap?"#define USE_DISPLACEMENTMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.mapUv?"#define MAP_UV "+e.mapUv:"",e.alphaMapUv?"#define ALPHAMAP_UV "+e.alphaMapUv:"",e.lightMapUv?"#define LIGHTMAP_UV "+e.lightMapUv:"",e.aoMapUv?"#define AOMAP_UV "+e.aoMapUv:"",e.emissiveMapUv?"#define EMISSIVEMAP_UV "+e.emissiveMapUv:"",e.bumpMapUv?"#define BUMPMAP_UV "+e.bumpMapUv:"",e.normalMapUv?"#define NORMALMAP_UV "+e.normalMapUv:"",e.displacementMapUv?"#define DISPLACEMENTMAP_UV "+e.displacementMapUv:"",e.metalnessMapUv?"#define METALNESSMAP_UV "+e.metalnessMapUv:"",e.roughnessMapUv?"#define ROUGHNESSMAP_UV "+e.roughnessMapUv:"",e.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+e.anisotropyMapUv:"",e.clearcoatMapUv?"#define CLEARCOATMAP_UV "+e.clearcoatMapUv:"",e.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+e.clearcoatNormalMapUv:"",e.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+e.clearcoatRoughnessMapUv:"",e.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+e.diffuseRoughnessMapUv:"",e.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+e.iridescenceMapUv:"",e.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+e.iridescenceThicknessMapUv:"",e.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+e.sheenColorMapUv:"",e.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+e.sheenRoughnessMapUv:"",e.specularMapUv?"#define SPECULARMAP_UV "+e.specularMapUv:"",e.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+e.specularColorMapUv:"",e.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+e.specularIntensityMapUv:"",e.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+e.transmissionMapUv:"",e.thicknessMapUv?"#define THICKNESSMAP_UV "+e.thicknessMapUv:"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexNormals?"#define HAS_NORMAL":"",e.vertexColors?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.flatShading?"#define FLAT_SHADED":"",e.skinning?"#define USE_SKINNING":"",e.morphTargets?"#define USE_MORPHTARGETS":"",e.morphNormals&&e.flatShading===!1?"#define USE_MORPHNORMALS":"",e.morphColors?"#define USE_MORPHCOLORS":"",e.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+e.morphTextureStride:"",e.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+e.morphTargetsCount:"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+c:"",e.sizeAttenuation?"#define USE_SIZEATTENUATION":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(Zo).join(`
`),p=[h0(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d,e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",e.map?"#define USE_MAP":"",e.matcap?"#define USE_MATCAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+l:"",e.envMap?"#define "+h:"",e.envMap?"#define "+u:"",e.envMapPMREM?"#define ENVMAP_MAX_LOD "+e.envMapMaxLod+".0":"",e.envMapPMREM?"#define ENVMAP_SIZE "+e.envMapSize+".0":"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoat?"#define USE_CLEARCOAT":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.dispersion?"#define USE_DISPERSION":"",e.retroreflection?"#define USE_RETROREFLECTION":"",e.iridescence?"#define USE_IRIDESCENCE":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaTest?"#define USE_ALPHATEST":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.sheen?"#define USE_SHEEN":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors||e.instancingColor?"#define USE_COLOR":"",e.vertexAlphas||e.batchingColor?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.gradientMap?"#define USE_GRADIENTMAP":"",e.flatShading?"#define FLAT_SHADED":"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+c:"",e.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",e.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",e.toneMapping!==Jn?"#define TONE_MAPPING":"",e.toneMapping!==Jn?Gt.tonemapping_pars_fragment:"",e.toneMapping!==Jn?p1("toneMapping",e.toneMapping):"",e.dithering?"#define DITHERING":"",e.opaque?"#define OPAQUE":"",Gt.colorspace_pars_fragment,f1("linearToOutputTexel",e.outputColorSpace),m1(),e.useDepthPacking?"#define DEPTH_PACKING "+e.depthPacking:"",`
`].filter(Zo).join(`
`)),o=Pf(o),o=a0(o,e),o=l0(o,e),a=Pf(a),a=a0(a,e),a=l0(a,e),o=c0(o),a=c0(a),e.isRawShaderMaterial!==!0&&(m=`#version 300 es
`,_=[f,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+_,p=["#define varying in",e.glslVersion===gf?"":"layout(location = 0) out highp vec4 pc_fragColor;",e.glslVersion===gf?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+p);let y=m+_+o,S=m+p+a,v=s0(s,s.VERTEX_SHADER,y),A=s0(s,s.FRAGMENT_SHADER,S);s.attachShader(g,v),s.attachShader(g,A),e.index0AttributeName!==void 0?s.bindAttribLocation(g,0,e.index0AttributeName):e.hasPositionAttribute===!0&&s.bindAttribLocation(g,0,"position"),s.linkProgram(g);function E(C){if(n.debug.checkShaderErrors){let L=s.getProgramInfoLog(g)||"",I=s.getShaderInfoLog(v)||"",B=s.getShaderInfoLog(A)||"",R=L.trim(),W=I.trim(),q=B.trim(),H=!0,K=!0;if(s.getProgramParameter(g,s.LINK_STATUS)===!1)if(H=!1,typeof n.debug.onShaderError=="function")n.debug.onShaderError(s,g,v,A);else{let X=o0(s,v,"vertex"),Y=o0(s,A,"fragment");Dt("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(g,s.VALIDATE_STATUS)+`

Material Name: `+C.name+`
Material Type: `+C.type+`

Program Info Log: `+R+`
`+X+`
`+Y)}else R!==""?It("WebGLProgram: Program Info Log:",R):(W===""||q==="")&&(K=!1);K&&(C.diagnostics={runnable:H,programLog:R,vertexShader:{log:W,prefix:_},fragmentShader:{log:q,prefix:p}})}s.deleteShader(v),s.deleteShader(A),x=new Ir(s,g),w=x1(s,g)}let x;this.getUniforms=function(){return x===void 0&&E(this),x};let w;this.getAttributes=function(){return w===void 0&&E(this),w};let U=e.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return U===!1&&(U=s.getProgramParameter(g,l1)),U},this.destroy=function(){i.releaseStatesOfProgram(this),s.deleteProgram(g),this.program=void 0},this.type=e.shaderType,this.name=e.shaderName,this.id=c1++,this.cacheKey=t,this.usedTimes=1,this.program=g,this.vertexShader=v,this.fragmentShader=A,this}var P1=0,If=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t,e,i){let s=this._getShaderCacheForMaterial(t);return s.has(e)===!1&&(s.add(e),e.usedTimes++),s.has(i)===!1&&(s.add(i),i.usedTimes++),this}remove(t){let e=this.materialCache.get(t);for(let i of e)i.usedTimes--,i.usedTimes===0&&this.shaderCache.delete(i.code);return this.materialCache.delete(t),this}getVertexShaderStage(t){return this._getShaderStage(t.vertexShader)}getFragmentShaderStage(t){return this._getShaderStage(t.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){let e=this.materialCache,i=e.get(t);return i===void 0&&(i=new Set,e.set(t,i)),i}_getShaderStage(t){let e=this.shaderCache,i=e.get(t);return i===void 0&&(i=new Lf(t),e.set(t,i)),i}},Lf=class{constructor(t){this.id=P1++,this.code=t,this.usedTimes=0}};function I1(n){return n===Ji||n===Wo||n===Xo}function L1(n,t,e,i,s,r){let o=new Mr,a=new If,c=new Set,l=[],h=new Map,u=i.logarithmicDepthBuffer,f={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function d(x){return c.add(x),x===0?"uv":`uv${x}`}function g(x,w,U,C,L,I){let B=C.fog,R=L.geometry,W=x.isMeshStandardMaterial||x.isMeshLambertMaterial||x.isMeshPhongMaterial?C.environment:null,q=x.isMeshStandardMaterial||x.isMeshLambertMaterial&&!x.envMap||x.isMeshPhongMaterial&&!x.envMap,H=t.get(x.envMap||W,q),K=f[x.type],X=i.precision;x.precision!==null&&(X=i.getMaxPrecision(x.precision),X!==x.precision&&It("WebGLProgram.getParameters:",x.precision,"not supported, using",X,"instead."));let Y=R.morphAttributes.position||R.morphAttributes.normal||R.morphAttributes.color,rt=Y!==void 0?Y.length:0,Z=0;R.morphAttributes.position!==void 0&&(Z=1),R.morphAttributes.normal!==void 0&&(Z=2),R.morphAttributes.color!==void 0&&(Z=3);let ot,z,it,F;if(K){let vt=en[K];ot=vt.vertexShader,z=vt.fragmentShader}else{ot=x.vertexShader,z=x.fragmentShader;let vt=a.getVertexShaderStage(x),ie=a.getFragmentShaderStage(x);a.update(x,vt,ie),it=vt.id,F=ie.id}let et=n.getRenderTarget(),st=n.state.buffers.depth.getReversed(),Mt=L.isInstancedMesh===!0,Wt=L.isBatchedMesh===!0,yt=!!x.map,Nt=!!x.matcap,Ht=!!H,Ct=Ht&&H.isPMREMTexture===!0,le=!!x.aoMap,jt=!!x.lightMap,ve=!!x.bumpMap&&x.wireframe===!1,me=!!x.normalMap,Vn=!!x.displacementMap,Ee=!!x.emissiveMap,mn=!!x.metalnessMap,gn=!!x.roughnessMap,_n=x.anisotropy>0,O=x.clearcoat>0,xn=x.diffuseRoughness>0,fe=x.dispersion>0,de=x.retroreflectivity>0,xt=x.iridescence>0,be=x.sheen>0,Lt=x.transmission>0,Ot=_n&&!!x.anisotropyMap,T=O&&!!x.clearcoatMap,b=O&&!!x.clearcoatNormalMap,V=O&&!!x.clearcoatRoughnessMap,at=xn&&!!x.diffuseRoughnessMap,nt=xt&&!!x.iridescenceMap,ht=xt&&!!x.iridescenceThicknessMap,mt=be&&!!x.sheenColorMap,j=be&&!!x.sheenRoughnessMap,Q=!!x.specularMap,ft=!!x.specularColorMap,P=!!x.specularIntensityMap,tt=Lt&&!!x.transmissionMap,J=Lt&&!!x.thicknessMap,dt=!!x.gradientMap,ct=!!x.alphaMap,ut=x.alphaTest>0,Tt=!!x.alphaHash,Vt=!!x.extensions,lt=Jn;x.toneMapped&&(et===null||et.isXRRenderTarget===!0)&&(lt=n.toneMapping);let Pt=Ct?H.isCompressedCubeTexture?H.image[0].mipmaps:H.mipmaps:null,kt={shaderID:K,shaderType:x.type,shaderName:x.name,vertexShader:ot,fragmentShader:z,defines:x.defines,customVertexShaderID:it,customFragmentShaderID:F,isRawShaderMaterial:x.isRawShaderMaterial===!0,glslVersion:x.glslVersion,precision:X,batching:Wt,batchingColor:Wt&&L._colorsTexture!==null,instancing:Mt,instancingColor:Mt&&L.instanceColor!==null,instancingMorph:Mt&&L.morphTexture!==null,outputColorSpace:et===null?n.outputColorSpace:et.isXRRenderTarget===!0?et.texture.colorSpace:Yt.workingColorSpace,alphaToCoverage:!!x.alphaToCoverage,map:yt,matcap:Nt,envMap:Ht,envMapMode:Ht&&H.mapping,envMapPMREM:Ct,envMapMaxLod:Ct?Pt.length-1:null,envMapSize:Ct?Pt[0].width:null,aoMap:le,lightMap:jt,bumpMap:ve,normalMap:me,displacementMap:Vn,emissiveMap:Ee,normalMapObjectSpace:me&&x.normalMapType===Dg,normalMapTangentSpace:me&&x.normalMapType===zc,packedNormalMap:me&&x.normalMapType===zc&&I1(x.normalMap.format),metalnessMap:mn,roughnessMap:gn,anisotropy:_n,anisotropyMap:Ot,clearcoat:O,clearcoatMap:T,clearcoatNormalMap:b,clearcoatRoughnessMap:V,diffuseRoughness:xn,diffuseRoughnessMap:at,dispersion:fe,retroreflection:de,iridescence:xt,iridescenceMap:nt,iridescenceThicknessMap:ht,sheen:be,sheenColorMap:mt,sheenRoughnessMap:j,specularMap:Q,specularColorMap:ft,specularIntensityMap:P,transmission:Lt,transmissionMap:tt,thicknessMap:J,gradientMap:dt,opaque:x.transparent===!1&&x.blending===Cr&&x.alphaToCoverage===!1,alphaMap:ct,alphaTest:ut,alphaHash:Tt,combine:x.combine,mapUv:yt&&d(x.map.channel),aoMapUv:le&&d(x.aoMap.channel),lightMapUv:jt&&d(x.lightMap.channel),bumpMapUv:ve&&d(x.bumpMap.channel),normalMapUv:me&&d(x.normalMap.channel),displacementMapUv:Vn&&d(x.displacementMap.channel),emissiveMapUv:Ee&&d(x.emissiveMap.channel),metalnessMapUv:mn&&d(x.metalnessMap.channel),roughnessMapUv:gn&&d(x.roughnessMap.channel),anisotropyMapUv:Ot&&d(x.anisotropyMap.channel),clearcoatMapUv:T&&d(x.clearcoatMap.channel),clearcoatNormalMapUv:b&&d(x.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:V&&d(x.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:at&&d(x.diffuseRoughnessMap.channel),iridescenceMapUv:nt&&d(x.iridescenceMap.channel),iridescenceThicknessMapUv:ht&&d(x.iridescenceThicknessMap.channel),sheenColorMapUv:mt&&d(x.sheenColorMap.channel),sheenRoughnessMapUv:j&&d(x.sheenRoughnessMap.channel),specularMapUv:Q&&d(x.specularMap.channel),specularColorMapUv:ft&&d(x.specularColorMap.channel),specularIntensityMapUv:P&&d(x.specularIntensityMap.channel),transmissionMapUv:tt&&d(x.transmissionMap.channel),thicknessMapUv:J&&d(x.thicknessMap.channel),alphaMapUv:ct&&d(x.alphaMap.channel),vertexTangents:!!R.attributes.tangent&&(me||_n),vertexNormals:!!R.attributes.normal,vertexColors:x.vertexColors,vertexAlphas:x.vertexColors===!0&&!!R.attributes.color&&R.attributes.color.itemSize===4,pointsUvs:L.isPoints===!0&&!!R.attributes.uv&&(yt||ct),fog:!!B,useFog:x.fog===!0,fogExp2:!!B&&B.isFogExp2,flatShading:x.wireframe===!1&&(x.flatShading===!0||R.attributes.normal===void 0&&me===!1&&(x.isMeshLambertMaterial||x.isMeshPhongMaterial||x.isMeshStandardMaterial||x.isMeshPhysicalMaterial)),sizeAttenuation:x.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:st,skinning:L.isSkinnedMesh===!0,hasPositionAttribute:R.attributes.position!==void 0,morphTargets:R.morphAttributes.position!==void 0,morphNormals:R.morphAttributes.normal!==void 0,morphColors:R.morphAttributes.color!==void 0,morphTargetsCount:rt,morphTextureStride:Z,numSunLights:w.sun.length,numDirLights:w.directional.length,numPointLights:w.point.length,numSpotLights:w.spot.length,numSpotLightMaps:w.spotLightMap.length,numRectAreaLights:w.rectArea.length,numHemiLights:w.hemi.length,numSunLightShadows:w.sunShadowMap.length,numDirLightShadows:w.directionalShadowMap.length,numPointLightShadows:w.pointShadowMap.length,numSpotLightShadows:w.spotShadowMap.length,numSpotLightShadowsWithMaps:w.numSpotLightShadowsWithMaps,numLightProbes:w.numLightProbes,numLightProbeGrids:I.filter(vt=>vt.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:x.dithering,shadowMapEnabled:n.shadowMap.enabled&&U.length>0,shadowMapType:n.shadowMap.type,toneMapping:lt,decodeVideoTexture:yt&&x.map.isVideoTexture===!0&&Yt.getTransfer(x.map.colorSpace)===ee,decodeVideoTextureEmissive:Ee&&x.emissiveMap.isVideoTexture===!0&&Yt.getTransfer(x.emissiveMap.colorSpace)===ee,premultipliedAlpha:x.premultipliedAlpha,doubleSided:x.side===Sn,flipSided:x.side===De,useDepthPacking:x.depthPacking>=0,depthPacking:x.depthPacking||0,index0AttributeName:x.index0AttributeName,extensionClipCullDistance:Vt&&x.extensions.clipCullDistance===!0&&e.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(Vt&&x.extensions.multiDraw===!0||Wt)&&e.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:e.has("KHR_parallel_shader_compile"),customProgramCacheKey:x.customProgramCacheKey()};return kt.vertexUv1s=c.has(1),kt.vertexUv2s=c.has(2),kt.vertexUv3s=c.has(3),c.clear(),kt}function _(x){let w=[];if(x.shaderID?w.push(x.shaderID):(w.push(x.customVertexShaderID),w.push(x.customFragmentShaderID)),x.defines!==void 0)for(let U in x.defines)w.push(U),w.push(x.defines[U]);return x.isRawShaderMaterial===!1&&(p(w,x),m(w,x),w.push(n.outputColorSpace)),w.push(x.customProgramCacheKey),w.join()}function p(x,w){x.push(w.precision),x.push(w.outputColorSpace),x.push(w.envMapMode),x.push(w.envMapPMREM),x.push(w.envMapMaxLod),x.push(w.envMapSize),x.push(w.mapUv),x.push(w.alphaMapUv),x.push(w.lightMapUv),x.push(w.aoMapUv),x.push(w.bumpMapUv),x.push(w.normalMapUv),x.push(w.displacementMapUv),x.push(w.emissiveMapUv),x.push(w.metalnessMapUv),x.push(w.roughnessMapUv),x.push(w.anisotropyMapUv),x.push(w.clearcoatMapUv),x.push(w.clearcoatNormalMapUv),x.push(w.clearcoatRoughnessMapUv),x.push(w.diffuseRoughnessMapUv),x.push(w.iridescenceMapUv),x.push(w.iridescenceThicknessMapUv),x.push(w.sheenColorMapUv),x.push(w.sheenRoughnessMapUv),x.push(w.specularMapUv),x.push(w.specularColorMapUv),x.push(w.specularIntensityMapUv),x.push(w.transmissionMapUv),x.push(w.thicknessMapUv),x.push(w.combine),x.push(w.fogExp2),x.push(w.sizeAttenuation),x.push(w.morphTargetsCount),x.push(w.numSunLights),x.push(w.numDirLights),x.push(w.numPointLights),x.push(w.numSpotLights),x.push(w.numSpotLightMaps),x.push(w.numHemiLights),x.push(w.numRectAreaLights),x.push(w.numSunLightShadows),x.push(w.numDirLightShadows),x.push(w.numPointLightShadows),x.push(w.numSpotLightShadows),x.push(w.numSpotLightShadowsWithMaps),x.push(w.numLightProbes),x.push(w.numLightProbeGrids),x.push(w.shadowMapType),x.push(w.toneMapping),x.push(w.numClippingPlanes),x.push(w.numClipIntersection),x.push(w.depthPacking)}function m(x,w){o.disableAll(),w.instancing&&o.enable(0),w.instancingColor&&o.enable(1),w.instancingMorph&&o.enable(2),w.matcap&&o.enable(3),w.envMap&&o.enable(4),w.normalMapObjectSpace&&o.enable(5),w.normalMapTangentSpace&&o.enable(6),w.clearcoat&&o.enable(7),w.iridescence&&o.enable(8),w.alphaTest&&o.enable(9),w.vertexColors&&o.enable(10),w.vertexAlphas&&o.enable(11),w.vertexUv1s&&o.enable(12),w.vertexUv2s&&o.enable(13),w.vertexUv3s&&o.enable(14),w.vertexTangents&&o.enable(15),w.anisotropy&&o.enable(16),w.alphaHash&&o.enable(17),w.batching&&o.enable(18),w.dispersion&&o.enable(19),w.retroreflection&&o.enable(24),w.diffuseRoughness&&o.enable(25),w.batchingColor&&o.enable(20),w.gradientMap&&o.enable(21),w.packedNormalMap&&o.enable(22),w.vertexNormals&&o.enable(23),x.push(o.mask),o.disableAll(),w.fog&&o.enable(0),w.useFog&&o.enable(1),w.flatShading&&o.enable(2),w.logarithmicDepthBuffer&&o.enable(3),w.reversedDepthBuffer&&o.enable(4),w.skinning&&o.enable(5),w.morphTargets&&o.enable(6),w.morphNormals&&o.enable(7),w.morphColors&&o.enable(8),w.premultipliedAlpha&&o.enable(9),w.shadowMapEnabled&&o.enable(10),w.doubleSided&&o.enable(11),w.flipSided&&o.enable(12),w.useDepthPacking&&o.enable(13),w.dithering&&o.enable(14),w.transmission&&o.enable(15),w.sheen&&o.enable(16),w.opaque&&o.enable(17),w.pointsUvs&&o.enable(18),w.decodeVideoTexture&&o.enable(19),w.decodeVideoTextureEmissive&&o.enable(20),w.alphaToCoverage&&o.enable(21),w.numLightProbeGrids>0&&o.enable(22),w.hasPositionAttribute&&o.enable(23),x.push(o.mask)}function y(x){let w=f[x.type],U;if(w){let C=en[w];U=qo.clone(C.uniforms)}else U=x.uniforms;return U}function S(x,w){let U=h.get(w);return U!==void 0?++U.usedTimes:(U=new R1(n,w,x,s),l.push(U),h.set(w,U)),U}function v(x){if(--x.usedTimes===0){let w=l.indexOf(x);l[w]=l[l.length-1],l.pop(),h.delete(x.cacheKey),x.destroy()}}function A(x){a.remove(x)}function E(){a.dispose()}return{getParameters:g,getProgramCacheKey:_,getUniforms:y,acquireProgram:S,releaseProgram:v,releaseShaderCache:A,programs:l,dispose:E}}function N1(){let n=new WeakMap;function t(o){return n.has(o)}function e(o){let a=n.get(o);return a===void 0&&(a={},n.set(o,a)),a}function i(o){n.delete(o)}function s(o,a,c){n.get(o)[a]=c}function r(){n=new WeakMap}return{has:t,get:e,remove:i,update:s,dispose:r}}function D1(n,t){return n.groupOrder!==t.groupOrder?n.groupOrder-t.groupOrder:n.renderOrder!==t.renderOrder?n.renderOrder-t.renderOrder:n.material.id!==t.material.id?n.material.id-t.material.id:n.materialVariant!==t.materialVariant?n.materialVariant-t.materialVariant:n.z!==t.z?n.z-t.z:n.id-t.id}function u0(n,t){return n.groupOrder!==t.groupOrder?n.groupOrder-t.groupOrder:n.renderOrder!==t.renderOrder?n.renderOrder-t.renderOrder:n.z!==t.z?t.z-n.z:n.id-t.id}function f0(){let n=[],t=0,e=[],i=[],s=[];function r(){t=0,e.length=0,i.length=0,s.length=0}function o(f){let d=0;return f.isInstancedMesh&&(d+=2),f.isSkinnedMesh&&(d+=1),d}function a(f,d,g,_,p,m){let y=n[t];return y===void 0?(y={id:f.id,object:f,geometry:d,material:g,materialVariant:o(f),groupOrder:_,renderOrder:f.renderOrder,z:p,group:m},n[t]=y):(y.id=f.id,y.object=f,y.geometry=d,y.material=g,y.materialVariant=o(f),y.groupOrder=_,y.renderOrder=f.renderOrder,y.z=p,y.group=m),t++,y}function c(f,d,g,_,p,m,y){y.reversedDepth===!0&&(p=-p);let S=a(f,d,g,_,p,m);g.transmission>0?i.push(S):g.transparent===!0?s.push(S):e.push(S)}function l(f,d,g,_,p,m){let y=a(f,d,g,_,p,m);g.transmission>0?i.unshift(y):g.transparent===!0?s.unshift(y):e.unshift(y)}function h(f,d){e.length>1&&e.sort(f||D1),i.length>1&&i.sort(d||u0),s.length>1&&s.sort(d||u0)}function u(){for(let f=t,d=n.length;f<d;f++){let g=n[f];if(g.id===null)break;g.id=null,g.object=null,g.geometry=null,g.material=null,g.group=null}}return{opaque:e,transmissive:i,transparent:s,init:r,push:c,unshift:l,finish:u,sort:h}}function U1(){let n=new WeakMap;function t(i,s){let r=n.get(i),o;return r===void 0?(o=new f0,n.set(i,[o])):s>=r.length?(o=new f0,r.push(o)):o=r[s],o}function e(){n=new WeakMap}return{get:t,dispose:e}}function O1(){let n={};return{get:function(t){if(n[t.id]!==void 0)return n[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={direction:new N,color:new zt};break;case"SpotLight":e={position:new N,direction:new N,color:new zt,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":e={position:new N,color:new zt,distance:0,decay:0};break;case"HemisphereLight":e={direction:new N,skyColor:new zt,groundColor:new zt};break;case"RectAreaLight":e={color:new zt,position:new N,halfWidth:new N,halfHeight:new N};break}return n[t.id]=e,e}}}function F1(){let n={};return{get:function(t){if(n[t.id]!==void 0)return n[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Rt};break;case"SpotLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Rt};break;case"PointLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Rt,shadowCameraNear:1,shadowCameraFar:1e3};break}return n[t.id]=e,e}}}var B1=0;function k1(n,t){return(t.castShadow?2:0)-(n.castShadow?2:0)+(t.map?1:0)-(n.map?1:0)}function z1(n){let t=new O1,e=F1(),i={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let l=0;l<9;l++)i.probe.push(new N);let s=new N,r=new oe,o=new oe;function a(l){let h=0,u=0,f=0;for(let I=0;I<9;I++)i.probe[I].set(0,0,0);let d=0,g=0,_=0,p=0,m=0,y=0,S=0,v=0,A=0,E=0,x=0,w=0,U=0,C=0;l.sort(k1);for(let I=0,B=l.length;I<B;I++){let R=l[I],W=R.color,q=R.intensity,H=R.distance,K=null;if(R.shadow&&R.shadow.map&&(R.shadow.map.texture.format===Ji?K=R.shadow.map.texture:K=R.shadow.map.depthTexture||R.shadow.map.texture),R.isAmbientLight)h+=W.r*q,u+=W.g*q,f+=W.b*q;else if(R.isLightProbe){for(let X=0;X<9;X++)i.probe[X].addScaledVector(R.sh.coefficients[X],q);C++}else if(R.isSunLight){let X=t.get(R);if(X.color.copy(R.color).multiplyScalar(R.intensity),R.castShadow){let Y=R.shadow,rt=e.get(R);rt.shadowIntensity=Y.intensity,rt.shadowBias=Y.bias,rt.shadowNormalBias=Y.normalBias,rt.shadowRadius=Y.radius,rt.shadowMapSize.copy(Y.mapSize).multiply(Y.getFrameExtents()),i.sunShadow[g]=rt,i.sunShadowMap[g]=K;let Z=Y.getViewportCount();for(let ot=0;ot<Z;ot++)i.sunShadowMatrix[_+ot]=Y.getMatrix(ot),i.sunShadowCascade[_+ot]=Y._cascadeData[ot];_+=Z,g++}i.sun[d]=X,d++}else if(R.isDirectionalLight){let X=t.get(R);if(X.color.copy(R.color).multiplyScalar(R.intensity),R.castShadow){let Y=R.shadow,rt=e.get(R);rt.shadowIntensity=Y.intensity,rt.shadowBias=Y.bias,rt.shadowNormalBias=Y.normalBias,rt.shadowRadius=Y.radius,rt.shadowMapSize=Y.mapSize,i.directionalShadow[p]=rt,i.directionalShadowMap[p]=K,i.directionalShadowMatrix[p]=R.shadow.matrix,A++}i.directional[p]=X,p++}else if(R.isSpotLight){let X=t.get(R);X.position.setFromMatrixPosition(R.matrixWorld),X.color.copy(W).multiplyScalar(q),X.distance=H,X.coneCos=Math.cos(R.angle),X.penumbraCos=Math.cos(R.angle*(1-R.penumbra)),X.decay=R.decay,i.spot[y]=X;let Y=R.shadow;if(R.map&&(i.spotLightMap[w]=R.map,w++,Y.updateMatrices(R),R.castShadow&&U++),i.spotLightMatrix[y]=Y.matrix,R.castShadow){let rt=e.get(R);rt.shadowIntensity=Y.intensity,rt.shadowBias=Y.bias,rt.shadowNormalBias=Y.normalBias,rt.shadowRadius=Y.radius,rt.shadowMapSize=Y.mapSize,i.spotShadow[y]=rt,i.spotShadowMap[y]=K,x++}y++}else if(R.isRectAreaLight){let X=t.get(R);X.color.copy(W).multiplyScalar(q),X.halfWidth.set(R.width*.5,0,0),X.halfHeight.set(0,R.height*.5,0),i.rectArea[S]=X,S++}else if(R.isPointLight){let X=t.get(R);if(X.color.copy(R.color).multiplyScalar(R.intensity),X.distance=R.distance,X.decay=R.decay,R.castShadow){let Y=R.shadow,rt=e.get(R);rt.shadowIntensity=Y.intensity,rt.shadowBias=Y.bias,rt.shadowNormalBias=Y.normalBias,rt.shadowRadius=Y.radius,rt.shadowMapSize=Y.mapSize,rt.shadowCameraNear=Y.camera.near,rt.shadowCameraFar=Y.camera.far,i.pointShadow[m]=rt,i.pointShadowMap[m]=K,i.pointShadowMatrix[m]=R.shadow.matrix,E++}i.point[m]=X,m++}else if(R.isHemisphereLight){let X=t.get(R);X.skyColor.copy(R.color).multiplyScalar(q),X.groundColor.copy(R.groundColor).multiplyScalar(q),i.hemi[v]=X,v++}}S>0&&(n.has("OES_texture_float_linear")===!0?(i.rectAreaLTC1=_t.LTC_FLOAT_1,i.rectAreaLTC2=_t.LTC_FLOAT_2):(i.rectAreaLTC1=_t.LTC_HALF_1,i.rectAreaLTC2=_t.LTC_HALF_2)),i.ambient[0]=h,i.ambient[1]=u,i.ambient[2]=f;let L=i.hash;(L.sunLength!==d||L.directionalLength!==p||L.pointLength!==m||L.spotLength!==y||L.rectAreaLength!==S||L.hemiLength!==v||L.numSunShadows!==g||L.numDirectionalShadows!==A||L.numPointShadows!==E||L.numSpotShadows!==x||L.numSpotMaps!==w||L.numLightProbes!==C)&&(i.sun.length=d,i.directional.length=p,i.spot.length=y,i.rectArea.length=S,i.point.length=m,i.hemi.length=v,i.sunShadow.length=g,i.sunShadowMap.length=g,i.sunShadowMatrix.length=_,i.sunShadowCascade.length=_,i.directionalShadow.length=A,i.directionalShadowMap.length=A,i.directionalShadowMatrix.length=A,i.pointShadow.length=E,i.pointShadowMap.length=E,i.pointShadowMatrix.length=E,i.spotShadow.length=x,i.spotShadowMap.length=x,i.spotLightMatrix.length=x+w-U,i.spotLightMap.length=w,i.numSpotLightShadowsWithMaps=U,i.numLightProbes=C,L.sunLength=d,L.directionalLength=p,L.pointLength=m,L.spotLength=y,L.rectAreaLength=S,L.hemiLength=v,L.numSunShadows=g,L.numDirectionalShadows=A,L.numPointShadows=E,L.numSpotShadows=x,L.numSpotMaps=w,L.numLightProbes=C,i.version=B1++)}function c(l,h){let u=0,f=0,d=0,g=0,_=0,p=0,m=h.matrixWorldInverse;for(let y=0,S=l.length;y<S;y++){let v=l[y];if(v.isSunLight){let A=i.sun[u];A.direction.setFromMatrixPosition(v.matrixWorld),A.direction.transformDirection(m),u++}else if(v.isDirectionalLight){let A=i.directional[f];A.direction.setFromMatrixPosition(v.matrixWorld),s.setFromMatrixPosition(v.target.matrixWorld),A.direction.sub(s),A.direction.transformDirection(m),f++}else if(v.isSpotLight){let A=i.spot[g];A.position.setFromMatrixPosition(v.matrixWorld),A.position.applyMatrix4(m),A.direction.setFromMatrixPosition(v.matrixWorld),s.setFromMatrixPosition(v.target.matrixWorld),A.direction.sub(s),A.direction.transformDirection(m),g++}else if(v.isRectAreaLight){let A=i.rectArea[_];A.position.setFromMatrixPosition(v.matrixWorld),A.position.applyMatrix4(m),o.identity(),r.copy(v.matrixWorld),r.premultiply(m),o.extractRotation(r),A.halfWidth.set(v.width*.5,0,0),A.halfHeight.set(0,v.height*.5,0),A.halfWidth.applyMatrix4(o),A.halfHeight.applyMatrix4(o),_++}else if(v.isPointLight){let A=i.point[d];A.position.setFromMatrixPosition(v.matrixWorld),A.position.applyMatrix4(m),d++}else if(v.isHemisphereLight){let A=i.hemi[p];A.direction.setFromMatrixPosition(v.matrixWorld),A.direction.transformDirection(m),p++}}}return{setup:a,setupView:c,state:i}}function d0(n){let t=new z1(n),e=[],i=[],s=[];function r(u){h.camera=u,e.length=0,i.length=0,s.length=0}function o(u){u.isLightProbeGrid?s.push(u):e.push(u)}function a(u){i.push(u)}function c(){t.setup(e),s.sort((u,f)=>u.priority-f.priority||u.id-f.id)}function l(u){t.setupView(e,u)}let h={lightsArray:e,shadowsArray:i,lightProbeGridArray:s,camera:null,lights:t,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:c,setupLightsView:l,pushLight:o,pushShadow:a}}function V1(n){let t=new WeakMap;function e(s,r=0){let o=t.get(s),a;return o===void 0?(a=new d0(n),t.set(s,[a])):r>=o.length?(a=new d0(n),o.push(a)):a=o[r],a}function i(){t=new WeakMap}return{get:e,dispose:i}}var G1=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,H1=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,W1=[new N(1,0,0),new N(-1,0,0),new N(0,1,0),new N(0,-1,0),new N(0,0,1),new N(0,0,-1)],X1=[new N(0,-1,0),new N(0,-1,0),new N(0,0,1),new N(0,0,-1),new N(0,-1,0),new N(0,-1,0)],p0=new oe,Yo=new N,Af=new N;function $1(n,t,e){let i=new Vi,s=new Rt,r=new Rt,o=new ne,a=new zl,c=new Vl,l={},h=e.maxTextureSize,u={[Zi]:De,[De]:Zi,[Sn]:Sn},f=new Mn({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new Rt},radius:{value:4}},vertexShader:G1,fragmentShader:H1}),d=f.clone();d.defines.HORIZONTAL_PASS=1;let g=new ue;g.setAttribute("position",new Ln(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let _=new _e(g,f),p=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=Bo;let m=this.type;this.render=function(E,x,w){if(p.enabled===!1||p.autoUpdate===!1&&p.needsUpdate===!1||E.length===0)return;this.type===ug&&(It("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=Bo);let U=n.getRenderTarget(),C=n.getActiveCubeFace(),L=n.getActiveMipmapLevel(),I=n.state;I.setBlending(As),I.buffers.depth.getReversed()===!0?I.buffers.color.setClear(0,0,0,0):I.buffers.color.setClear(1,1,1,1),I.buffers.depth.setTest(!0),I.setScissorTest(!1);let B=m!==this.type;B&&x.traverse(function(R){R.material&&(Array.isArray(R.material)?R.material.forEach(W=>W.needsUpdate=!0):R.material.needsUpdate=!0)});for(let R=0,W=E.length;R<W;R++){let q=E[R],H=q.shadow;if(H===void 0){It("WebGLShadowMap:",q,"has no shadow.");continue}if(H.autoUpdate===!1&&H.needsUpdate===!1)continue;s.copy(H.mapSize);let K=H.getFrameExtents();s.multiply(K),r.copy(H.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/K.x),s.x=r.x*K.x,H.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/K.y),s.y=r.y*K.y,H.mapSize.y=r.y));let X=n.state.buffers.depth.getReversed();if(H.camera._reversedDepth=X,H.map===null||B===!0){if(H.map!==null&&(H.map.depthTexture!==null&&(H.map.depthTexture.dispose(),H.map.depthTexture=null),H.map.dispose()),this.type===Tr){if(q.isPointLight){It("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}H.map=new fn(s.x,s.y,{format:Ji,type:kn,minFilter:Qe,magFilter:Qe,generateMipmaps:!1}),H.map.texture.name=q.name+".shadowMap",H.map.depthTexture=new Mi(s.x,s.y,Bn),H.map.depthTexture.name=q.name+".shadowMapDepth",H.map.depthTexture.format=xi,H.map.depthTexture.compareFunction=null,H.map.depthTexture.minFilter=Ie,H.map.depthTexture.magFilter=Ie}else q.isPointLight?(H.map=new Jo(s.x),H.map.depthTexture=new Mo(s.x,Fn)):(H.map=new fn(s.x,s.y),H.map.depthTexture=new Mi(s.x,s.y,Fn)),H.map.depthTexture.name=q.name+".shadowMap",H.map.depthTexture.format=xi,this.type===Bo?(H.map.depthTexture.compareFunction=X?df:ff,H.map.depthTexture.minFilter=Qe,H.map.depthTexture.magFilter=Qe):(H.map.depthTexture.compareFunction=null,H.map.depthTexture.minFilter=Ie,H.map.depthTexture.magFilter=Ie);H.camera.updateProjectionMatrix()}H.map.isWebGLCubeRenderTarget!==!0&&(H.map.width!==s.x||H.map.height!==s.y)&&H.map.setSize(s.x,s.y);let Y=H.map.isWebGLCubeRenderTarget?6:H.getViewportCount();q.isPointLight!==!0&&H.updateMatrices(q,w);let rt=(H.camera.layers.mask&4294967294)!==0?H.camera.layers:w.layers;for(let Z=0;Z<Y;Z++){let ot=H.getCamera(Z);if(q.isPointLight){let z=H.camera,it=H.matrix,F=q.distance||z.far;F!==z.far&&(z.far=F,z.updateProjectionMatrix()),Yo.setFromMatrixPosition(q.matrixWorld),z.position.copy(Yo),Af.copy(z.position),Af.add(W1[Z]),z.up.copy(X1[Z]),z.lookAt(Af),z.updateMatrixWorld(),it.makeTranslation(-Yo.x,-Yo.y,-Yo.z),p0.multiplyMatrices(z.projectionMatrix,z.matrixWorldInverse),H._frustum.setFromProjectionMatrix(p0,z.coordinateSystem,z.reversedDepth)}if(H.map.isWebGLCubeRenderTarget)n.setRenderTarget(H.map,Z),n.clear();else{Z===0&&(n.setRenderTarget(H.map),n.clear());let z=H.getViewport(Z);o.set(r.x*z.x,r.y*z.y,r.x*z.z,r.y*z.w),I.viewport(o)}i=H.getFrustum(Z),v(x,w,ot,q,rt,this.type)}H.isPointLightShadow!==!0&&this.type===Tr&&y(H,w),H.needsUpdate=!1}m=this.type,p.needsUpdate=!1,n.setRenderTarget(U,C,L)};function y(E,x){let w=t.update(_);f.defines.VSM_SAMPLES!==E.blurSamples&&(f.defines.VSM_SAMPLES=E.blurSamples,d.defines.VSM_SAMPLES=E.blurSamples,f.needsUpdate=!0,d.needsUpdate=!0),E.mapPass===null?E.mapPass=new fn(s.x,s.y,{format:Ji,type:kn}):(E.mapPass.width!==E.map.width||E.mapPass.height!==E.map.height)&&E.mapPass.setSize(E.map.width,E.map.height),f.uniforms.shadow_pass.value=E.map.depthTexture,f.uniforms.resolution.value.set(E.map.width,E.map.height),f.uniforms.radius.value=E.radius,n.setRenderTarget(E.mapPass),n.clear(),n.renderBufferDirect(x,null,w,f,_,null),d.uniforms.shadow_pass.value=E.mapPass.texture,d.uniforms.resolution.value.set(E.map.width,E.map.height),d.uniforms.radius.value=E.radius,n.setRenderTarget(E.map),n.clear(),n.renderBufferDirect(x,null,w,d,_,null)}function S(E,x,w,U){let C=null,L=w.isPointLight===!0?E.customDistanceMaterial:E.customDepthMaterial;if(L!==void 0)C=L;else if(C=w.isPointLight===!0?c:a,n.localClippingEnabled&&x.clipShadows===!0&&Array.isArray(x.clippingPlanes)&&x.clippingPlanes.length!==0||x.displacementMap&&x.displacementScale!==0||x.alphaMap&&x.alphaTest>0||x.map&&x.alphaTest>0||x.alphaToCoverage===!0){let I=C.uuid,B=x.uuid,R=l[I];R===void 0&&(R={},l[I]=R);let W=R[B];W===void 0&&(W=C.clone(),R[B]=W,x.addEventListener("dispose",A)),C=W}if(C.visible=x.visible,C.wireframe=x.wireframe,U===Tr?C.side=x.shadowSide!==null?x.shadowSide:x.side:C.side=x.shadowSide!==null?x.shadowSide:u[x.side],C.alphaMap=x.alphaMap,C.alphaTest=x.alphaToCoverage===!0?.5:x.alphaTest,C.map=x.map,C.clipShadows=x.clipShadows,C.clippingPlanes=x.clippingPlanes,C.clipIntersection=x.clipIntersection,C.displacementMap=x.displacementMap,C.displacementScale=x.displacementScale,C.displacementBias=x.displacementBias,C.wireframeLinewidth=x.wireframeLinewidth,C.linewidth=x.linewidth,w.isPointLight===!0&&C.isMeshDistanceMaterial===!0){let I=n.properties.get(C);I.light=w}return C}function v(E,x,w,U,C,L){if(E.visible===!1)return;if(E.layers.test(C)&&(E.isMesh||E.isLine||E.isPoints)&&(E.castShadow||E.receiveShadow&&L===Tr)&&(!E.frustumCulled||E.intersectsFrustum(i))){E.modelViewMatrix.multiplyMatrices(w.matrixWorldInverse,E.matrixWorld);let R=t.update(E),W=E.material;if(Array.isArray(W)){let q=R.groups;for(let H=0,K=q.length;H<K;H++){let X=q[H],Y=W[X.materialIndex];if(Y&&Y.visible){let rt=S(E,Y,U,L);E.onBeforeShadow(n,E,x,w,R,rt,X),n.renderBufferDirect(w,null,R,rt,E,X),E.onAfterShadow(n,E,x,w,R,rt,X)}}}else if(W.visible){let q=S(E,W,U,L);E.onBeforeShadow(n,E,x,w,R,q,null),n.renderBufferDirect(w,null,R,q,E,null),E.onAfterShadow(n,E,x,w,R,q,null)}}let B=E.children;for(let R=0,W=B.length;R<W;R++)v(B[R],x,w,U,C,L)}function A(E){E.target.removeEventListener("dispose",A);for(let w in l){let U=l[w],C=E.target.uuid;C in U&&(U[C].dispose(),delete U[C])}}}function q1(n,t){function e(){let P=!1,tt=new ne,J=null,dt=new ne(0,0,0,0);return{setMask:function(ct){J!==ct&&!P&&(n.colorMask(ct,ct,ct,ct),J=ct)},setLocked:function(ct){P=ct},setClear:function(ct,ut,Tt,Vt,lt){lt===!0&&(ct*=Vt,ut*=Vt,Tt*=Vt),tt.set(ct,ut,Tt,Vt),dt.equals(tt)===!1&&(n.clearColor(ct,ut,Tt,Vt),dt.copy(tt))},reset:function(){P=!1,J=null,dt.set(-1,0,0,0)}}}function i(){let P=!1,tt=!1,J=null,dt=null,ct=null;return{setReversed:function(ut){if(tt!==ut){let Tt=t.get("EXT_clip_control");ut?Tt.clipControlEXT(Tt.LOWER_LEFT_EXT,Tt.ZERO_TO_ONE_EXT):Tt.clipControlEXT(Tt.LOWER_LEFT_EXT,Tt.NEGATIVE_ONE_TO_ONE_EXT),tt=ut;let Vt=ct;ct=null,this.setClear(Vt)}},getReversed:function(){return tt},setTest:function(ut){ut?st(n.DEPTH_TEST):Mt(n.DEPTH_TEST)},setMask:function(ut){J!==ut&&!P&&(n.depthMask(ut),J=ut)},setFunc:function(ut){if(tt&&(ut=Wg[ut]),dt!==ut){switch(ut){case vl:n.depthFunc(n.NEVER);break;case bl:n.depthFunc(n.ALWAYS);break;case Ml:n.depthFunc(n.LESS);break;case _r:n.depthFunc(n.LEQUAL);break;case Sl:n.depthFunc(n.EQUAL);break;case wl:n.depthFunc(n.GEQUAL);break;case El:n.depthFunc(n.GREATER);break;case Al:n.depthFunc(n.NOTEQUAL);break;default:n.depthFunc(n.LEQUAL)}dt=ut}},setLocked:function(ut){P=ut},setClear:function(ut){ct!==ut&&(ct=ut,tt&&(ut=1-ut),n.clearDepth(ut))},reset:function(){P=!1,J=null,dt=null,ct=null,tt=!1}}}function s(){let P=!1,tt=null,J=null,dt=null,ct=null,ut=null,Tt=null,Vt=null,lt=null;return{setTest:function(Pt){P||(Pt?st(n.STENCIL_TEST):Mt(n.STENCIL_TEST))},setMask:function(Pt){tt!==Pt&&!P&&(n.stencilMask(Pt),tt=Pt)},setFunc:function(Pt,kt,vt){(J!==Pt||dt!==kt||ct!==vt)&&(n.stencilFunc(Pt,kt,vt),J=Pt,dt=kt,ct=vt)},setOp:function(Pt,kt,vt){(ut!==Pt||Tt!==kt||Vt!==vt)&&(n.stencilOp(Pt,kt,vt),ut=Pt,Tt=kt,Vt=vt)},setLocked:function(Pt){P=Pt},setClear:function(Pt){lt!==Pt&&(n.clearStencil(Pt),lt=Pt)},reset:function(){P=!1,tt=null,J=null,dt=null,ct=null,ut=null,Tt=null,Vt=null,lt=null}}}let r=new e,o=new i,a=new s,c={},l=new WeakMap,h={},u={},f={},d=new WeakMap,g=[],_=null,p=!1,m=null,y=null,S=null,v=null,A=null,E=null,x=null,w=new zt(0,0,0),U=0,C=!1,L=null,I=null,B=null,R=null,W=null,q=n.getParameter(n.MAX_COMBINED_TEXTURE_IMAGE_UNITS),H=!1,K=0,X=n.getParameter(n.VERSION);X.indexOf("WebGL")!==-1?(K=parseFloat(/^WebGL (\d)/.exec(X)[1]),H=K>=1):X.indexOf("OpenGL ES")!==-1&&(K=parseFloat(/^OpenGL ES (\d)/.exec(X)[1]),H=K>=2);let Y=null,rt={},Z=n.getParameter(n.SCISSOR_BOX),ot=n.getParameter(n.VIEWPORT),z=new ne().fromArray(Z),it=new ne().fromArray(ot);function F(P,tt,J,dt){let ct=new Uint8Array(4),ut=n.createTexture();n.bindTexture(P,ut),n.texParameteri(P,n.TEXTURE_MIN_FILTER,n.NEAREST),n.texParameteri(P,n.TEXTURE_MAG_FILTER,n.NEAREST);for(let Tt=0;Tt<J;Tt++)P===n.TEXTURE_3D||P===n.TEXTURE_2D_ARRAY?n.texImage3D(tt,0,n.RGBA,1,1,dt,0,n.RGBA,n.UNSIGNED_BYTE,ct):n.texImage2D(tt+Tt,0,n.RGBA,1,1,0,n.RGBA,n.UNSIGNED_BYTE,ct);return ut}let et={};et[n.TEXTURE_2D]=F(n.TEXTURE_2D,n.TEXTURE_2D,1),et[n.TEXTURE_CUBE_MAP]=F(n.TEXTURE_CUBE_MAP,n.TEXTURE_CUBE_MAP_POSITIVE_X,6),et[n.TEXTURE_2D_ARRAY]=F(n.TEXTURE_2D_ARRAY,n.TEXTURE_2D_ARRAY,1,1),et[n.TEXTURE_3D]=F(n.TEXTURE_3D,n.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),st(n.DEPTH_TEST),o.setFunc(_r),ve(!1),me(Wu),st(n.CULL_FACE),le(As);function st(P){h[P]!==!0&&(n.enable(P),h[P]=!0)}function Mt(P){h[P]!==!1&&(n.disable(P),h[P]=!1)}function Wt(P,tt){return f[P]!==tt?(n.bindFramebuffer(P,tt),f[P]=tt,P===n.DRAW_FRAMEBUFFER&&(f[n.FRAMEBUFFER]=tt),P===n.FRAMEBUFFER&&(f[n.DRAW_FRAMEBUFFER]=tt),!0):!1}function yt(P,tt){let J=g,dt=!1;if(P){J=d.get(tt),J===void 0&&(J=[],d.set(tt,J));let ct=P.textures;if(J.length!==ct.length||J[0]!==n.COLOR_ATTACHMENT0){for(let ut=0,Tt=ct.length;ut<Tt;ut++)J[ut]=n.COLOR_ATTACHMENT0+ut;J.length=ct.length,dt=!0}}else J[0]!==n.BACK&&(J[0]=n.BACK,dt=!0);dt&&n.drawBuffers(J)}function Nt(P){return _!==P?(n.useProgram(P),_=P,!0):!1}let Ht={[Ts]:n.FUNC_ADD,[dg]:n.FUNC_SUBTRACT,[pg]:n.FUNC_REVERSE_SUBTRACT};Ht[mg]=n.MIN,Ht[gg]=n.MAX;let Ct={[_g]:n.ZERO,[xg]:n.ONE,[yg]:n.SRC_COLOR,[Yu]:n.SRC_ALPHA,[Eg]:n.SRC_ALPHA_SATURATE,[Sg]:n.DST_COLOR,[bg]:n.DST_ALPHA,[vg]:n.ONE_MINUS_SRC_COLOR,[Zu]:n.ONE_MINUS_SRC_ALPHA,[wg]:n.ONE_MINUS_DST_COLOR,[Mg]:n.ONE_MINUS_DST_ALPHA,[Ag]:n.CONSTANT_COLOR,[Tg]:n.ONE_MINUS_CONSTANT_COLOR,[Cg]:n.CONSTANT_ALPHA,[Rg]:n.ONE_MINUS_CONSTANT_ALPHA};function le(P,tt,J,dt,ct,ut,Tt,Vt,lt,Pt){if(P===As){p===!0&&(Mt(n.BLEND),p=!1);return}if(p===!1&&(st(n.BLEND),p=!0),P!==fg){if(P!==m||Pt!==C){if((y!==Ts||A!==Ts)&&(n.blendEquation(n.FUNC_ADD),y=Ts,A=Ts),Pt)switch(P){case Cr:n.blendFuncSeparate(n.ONE,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case Xu:n.blendFunc(n.ONE,n.ONE);break;case $u:n.blendFuncSeparate(n.ZERO,n.ONE_MINUS_SRC_COLOR,n.ZERO,n.ONE);break;case qu:n.blendFuncSeparate(n.DST_COLOR,n.ONE_MINUS_SRC_ALPHA,n.ZERO,n.ONE);break;default:Dt("WebGLState: Invalid blending: ",P);break}else switch(P){case Cr:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case Xu:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE,n.ONE,n.ONE);break;case $u:Dt("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case qu:Dt("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:Dt("WebGLState: Invalid blending: ",P);break}S=null,v=null,E=null,x=null,w.set(0,0,0),U=0,m=P,C=Pt}return}ct=ct||tt,ut=ut||J,Tt=Tt||dt,(tt!==y||ct!==A)&&(n.blendEquationSeparate(Ht[tt],Ht[ct]),y=tt,A=ct),(J!==S||dt!==v||ut!==E||Tt!==x)&&(n.blendFuncSeparate(Ct[J],Ct[dt],Ct[ut],Ct[Tt]),S=J,v=dt,E=ut,x=Tt),(Vt.equals(w)===!1||lt!==U)&&(n.blendColor(Vt.r,Vt.g,Vt.b,lt),w.copy(Vt),U=lt),m=P,C=!1}function jt(P,tt){P.side===Sn?Mt(n.CULL_FACE):st(n.CULL_FACE);let J=P.side===De;tt&&(J=!J),ve(J),P.blending===Cr&&P.transparent===!1?le(As):le(P.blending,P.blendEquation,P.blendSrc,P.blendDst,P.blendEquationAlpha,P.blendSrcAlpha,P.blendDstAlpha,P.blendColor,P.blendAlpha,P.premultipliedAlpha),o.setFunc(P.depthFunc),o.setTest(P.depthTest),o.setMask(P.depthWrite),r.setMask(P.colorWrite);let dt=P.stencilWrite;a.setTest(dt),dt&&(a.setMask(P.stencilWriteMask),a.setFunc(P.stencilFunc,P.stencilRef,P.stencilFuncMask),a.setOp(P.stencilFail,P.stencilZFail,P.stencilZPass)),Ee(P.polygonOffset,P.polygonOffsetFactor,P.polygonOffsetUnits),P.alphaToCoverage===!0?st(n.SAMPLE_ALPHA_TO_COVERAGE):Mt(n.SAMPLE_ALPHA_TO_COVERAGE)}function ve(P){L!==P&&(P?n.frontFace(n.CW):n.frontFace(n.CCW),L=P)}function me(P){P!==cg?(st(n.CULL_FACE),P!==I&&(P===Wu?n.cullFace(n.BACK):P===hg?n.cullFace(n.FRONT):n.cullFace(n.FRONT_AND_BACK))):Mt(n.CULL_FACE),I=P}function Vn(P){P!==B&&(H&&n.lineWidth(P),B=P)}function Ee(P,tt,J){P?(st(n.POLYGON_OFFSET_FILL),(R!==tt||W!==J)&&(R=tt,W=J,o.getReversed()&&(tt=-tt,J=-J),n.polygonOffset(tt,J))):Mt(n.POLYGON_OFFSET_FILL)}function mn(P){P?st(n.SCISSOR_TEST):Mt(n.SCISSOR_TEST)}function gn(P){P===void 0&&(P=n.TEXTURE0+q-1),Y!==P&&(n.activeTexture(P),Y=P)}function _n(P,tt,J){J===void 0&&(Y===null?J=n.TEXTURE0+q-1:J=Y);let dt=rt[J];dt===void 0&&(dt={type:void 0,texture:void 0},rt[J]=dt),(dt.type!==P||dt.texture!==tt)&&(Y!==J&&(n.activeTexture(J),Y=J),n.bindTexture(P,tt||et[P]),dt.type=P,dt.texture=tt)}function O(){let P=rt[Y];P!==void 0&&P.type!==void 0&&(n.bindTexture(P.type,null),P.type=void 0,P.texture=void 0)}function xn(){try{n.compressedTexImage2D(...arguments)}catch(P){Dt("WebGLState:",P)}}function fe(){try{n.compressedTexImage3D(...arguments)}catch(P){Dt("WebGLState:",P)}}function de(){try{n.texSubImage2D(...arguments)}catch(P){Dt("WebGLState:",P)}}function xt(){try{n.texSubImage3D(...arguments)}catch(P){Dt("WebGLState:",P)}}function be(){try{n.compressedTexSubImage2D(...arguments)}catch(P){Dt("WebGLState:",P)}}function Lt(){try{n.compressedTexSubImage3D(...arguments)}catch(P){Dt("WebGLState:",P)}}function Ot(){try{n.texStorage2D(...arguments)}catch(P){Dt("WebGLState:",P)}}function T(){try{n.texStorage3D(...arguments)}catch(P){Dt("WebGLState:",P)}}function b(){try{n.texImage2D(...arguments)}catch(P){Dt("WebGLState:",P)}}function V(){try{n.texImage3D(...arguments)}catch(P){Dt("WebGLState:",P)}}function at(P){return u[P]!==void 0?u[P]:n.getParameter(P)}function nt(P,tt){u[P]!==tt&&(n.pixelStorei(P,tt),u[P]=tt)}function ht(P){z.equals(P)===!1&&(n.scissor(P.x,P.y,P.z,P.w),z.copy(P))}function mt(P){it.equals(P)===!1&&(n.viewport(P.x,P.y,P.z,P.w),it.copy(P))}function j(P,tt){let J=l.get(tt);J===void 0&&(J=new WeakMap,l.set(tt,J));let dt=J.get(P);dt===void 0&&(dt=n.getUniformBlockIndex(tt,P.name),n.uniformBlockBinding(tt,dt,dt),J.set(P,dt))}function Q(P,tt,J){let ct=l.get(tt).get(P);c[ct]!==J&&(n.bindBufferBase(n.UNIFORM_BUFFER,ct,J),c[ct]=J)}function ft(){n.disable(n.BLEND),n.disable(n.CULL_FACE),n.disable(n.DEPTH_TEST),n.disable(n.POLYGON_OFFSET_FILL),n.disable(n.SCISSOR_TEST),n.disable(n.STENCIL_TEST),n.disable(n.SAMPLE_ALPHA_TO_COVERAGE),n.blendEquation(n.FUNC_ADD),n.blendFunc(n.ONE,n.ZERO),n.blendFuncSeparate(n.ONE,n.ZERO,n.ONE,n.ZERO),n.blendColor(0,0,0,0),n.colorMask(!0,!0,!0,!0),n.clearColor(0,0,0,0),n.depthMask(!0),n.depthFunc(n.LESS),o.setReversed(!1),n.clearDepth(1),n.stencilMask(4294967295),n.stencilFunc(n.ALWAYS,0,4294967295),n.stencilOp(n.KEEP,n.KEEP,n.KEEP),n.clearStencil(0),n.cullFace(n.BACK),n.frontFace(n.CCW),n.polygonOffset(0,0),n.activeTexture(n.TEXTURE0),n.bindFramebuffer(n.FRAMEBUFFER,null),n.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),n.bindFramebuffer(n.READ_FRAMEBUFFER,null),n.useProgram(null),n.lineWidth(1),n.scissor(0,0,n.canvas.width,n.canvas.height),n.viewport(0,0,n.canvas.width,n.canvas.height),n.pixelStorei(n.PACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,!1),n.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),n.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,n.BROWSER_DEFAULT_WEBGL),n.pixelStorei(n.PACK_ROW_LENGTH,0),n.pixelStorei(n.PACK_SKIP_PIXELS,0),n.pixelStorei(n.PACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_ROW_LENGTH,0),n.pixelStorei(n.UNPACK_IMAGE_HEIGHT,0),n.pixelStorei(n.UNPACK_SKIP_PIXELS,0),n.pixelStorei(n.UNPACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_SKIP_IMAGES,0),h={},u={},Y=null,rt={},f={},c={},d=new WeakMap,g=[],_=null,p=!1,m=null,y=null,S=null,v=null,A=null,E=null,x=null,w=new zt(0,0,0),U=0,C=!1,L=null,I=null,B=null,R=null,W=null,z.set(0,0,n.canvas.width,n.canvas.height),it.set(0,0,n.canvas.width,n.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:st,disable:Mt,bindFramebuffer:Wt,drawBuffers:yt,useProgram:Nt,setBlending:le,setMaterial:jt,setFlipSided:ve,setCullFace:me,setLineWidth:Vn,setPolygonOffset:Ee,setScissorTest:mn,activeTexture:gn,bindTexture:_n,unbindTexture:O,compressedTexImage2D:xn,compressedTexImage3D:fe,texImage2D:b,texImage3D:V,pixelStorei:nt,getParameter:at,updateUBOMapping:j,uniformBlockBinding:Q,texStorage2D:Ot,texStorage3D:T,texSubImage2D:de,texSubImage3D:xt,compressedTexSubImage2D:be,compressedTexSubImage3D:Lt,scissor:ht,viewport:mt,reset:ft}}function Y1(n,t,e,i,s,r,o){let a=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,c=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),l=new Rt,h=new WeakMap,u=new Set,f,d=new WeakMap,g=new Set,_=new FinalizationRegistry(T=>g.delete(T)),p=!1;try{p=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function m(T,b){return p?new OffscreenCanvas(T,b):mo("canvas")}function y(T,b,V){let at=1,nt=Ot(T);if((nt.width>V||nt.height>V)&&(at=V/Math.max(nt.width,nt.height)),at<1)if(typeof HTMLImageElement<"u"&&T instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&T instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&T instanceof ImageBitmap||typeof VideoFrame<"u"&&T instanceof VideoFrame){let ht=Math.floor(at*nt.width),mt=Math.floor(at*nt.height);f===void 0&&(f=m(ht,mt));let j=b?m(ht,mt):f;return j.width=ht,j.height=mt,j.getContext("2d").drawImage(T,0,0,ht,mt),It("WebGLRenderer: Texture has been resized from ("+nt.width+"x"+nt.height+") to ("+ht+"x"+mt+")."),j}else return"data"in T&&It("WebGLRenderer: Image in DataTexture is too big ("+nt.width+"x"+nt.height+")."),T;return T}function S(T){return T.generateMipmaps}function v(T){n.generateMipmap(T)}function A(T){return T.isWebGLCubeRenderTarget?n.TEXTURE_CUBE_MAP:T.isWebGL3DRenderTarget?n.TEXTURE_3D:T.isWebGLArrayRenderTarget||T.isCompressedArrayTexture?n.TEXTURE_2D_ARRAY:n.TEXTURE_2D}function E(T,b,V,at,nt,ht=!1){if(T!==null){if(n[T]!==void 0)return n[T];It("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+T+"'")}let mt;at&&(mt=t.get("EXT_texture_norm16"),mt||It("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let j=b;if(b===n.RED&&(V===n.FLOAT&&(j=n.R32F),V===n.HALF_FLOAT&&(j=n.R16F),V===n.UNSIGNED_BYTE&&(j=n.R8),V===n.UNSIGNED_SHORT&&mt&&(j=mt.R16_EXT),V===n.SHORT&&mt&&(j=mt.R16_SNORM_EXT)),b===n.RED_INTEGER&&(V===n.UNSIGNED_BYTE&&(j=n.R8UI),V===n.UNSIGNED_SHORT&&(j=n.R16UI),V===n.UNSIGNED_INT&&(j=n.R32UI),V===n.BYTE&&(j=n.R8I),V===n.SHORT&&(j=n.R16I),V===n.INT&&(j=n.R32I)),b===n.RG&&(V===n.FLOAT&&(j=n.RG32F),V===n.HALF_FLOAT&&(j=n.RG16F),V===n.UNSIGNED_BYTE&&(j=n.RG8),V===n.UNSIGNED_SHORT&&mt&&(j=mt.RG16_EXT),V===n.SHORT&&mt&&(j=mt.RG16_SNORM_EXT)),b===n.RG_INTEGER&&(V===n.UNSIGNED_BYTE&&(j=n.RG8UI),V===n.UNSIGNED_SHORT&&(j=n.RG16UI),V===n.UNSIGNED_INT&&(j=n.RG32UI),V===n.BYTE&&(j=n.RG8I),V===n.SHORT&&(j=n.RG16I),V===n.INT&&(j=n.RG32I)),b===n.RGB_INTEGER&&(V===n.UNSIGNED_BYTE&&(j=n.RGB8UI),V===n.UNSIGNED_SHORT&&(j=n.RGB16UI),V===n.UNSIGNED_INT&&(j=n.RGB32UI),V===n.BYTE&&(j=n.RGB8I),V===n.SHORT&&(j=n.RGB16I),V===n.INT&&(j=n.RGB32I)),b===n.RGBA_INTEGER&&(V===n.UNSIGNED_BYTE&&(j=n.RGBA8UI),V===n.UNSIGNED_SHORT&&(j=n.RGBA16UI),V===n.UNSIGNED_INT&&(j=n.RGBA32UI),V===n.BYTE&&(j=n.RGBA8I),V===n.SHORT&&(j=n.RGBA16I),V===n.INT&&(j=n.RGBA32I)),b===n.RGB&&(V===n.UNSIGNED_SHORT&&mt&&(j=mt.RGB16_EXT),V===n.SHORT&&mt&&(j=mt.RGB16_SNORM_EXT),V===n.UNSIGNED_INT_5_9_9_9_REV&&(j=n.RGB9_E5),V===n.UNSIGNED_INT_10F_11F_11F_REV&&(j=n.R11F_G11F_B10F)),b===n.RGBA){let Q=ht?po:Yt.getTransfer(nt);V===n.FLOAT&&(j=n.RGBA32F),V===n.HALF_FLOAT&&(j=n.RGBA16F),V===n.UNSIGNED_BYTE&&(j=Q===ee?n.SRGB8_ALPHA8:n.RGBA8),V===n.UNSIGNED_SHORT&&mt&&(j=mt.RGBA16_EXT),V===n.SHORT&&mt&&(j=mt.RGBA16_SNORM_EXT),V===n.UNSIGNED_SHORT_4_4_4_4&&(j=n.RGBA4),V===n.UNSIGNED_SHORT_5_5_5_1&&(j=n.RGB5_A1)}return(j===n.R16F||j===n.R32F||j===n.RG16F||j===n.RG32F||j===n.RGBA16F||j===n.RGBA32F)&&t.get("EXT_color_buffer_float"),j}function x(T,b){let V;return T?b===null||b===Fn||b===Rs?V=n.DEPTH24_STENCIL8:b===Bn?V=n.DEPTH32F_STENCIL8:b===Pr&&(V=n.DEPTH24_STENCIL8,It("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):b===null||b===Fn||b===Rs?V=n.DEPTH_COMPONENT24:b===Bn?V=n.DEPTH_COMPONENT32F:b===Pr&&(V=n.DEPTH_COMPONENT16),V}function w(T,b){return S(T)===!0||T.isFramebufferTexture&&T.minFilter!==Ie&&T.minFilter!==Qe?Math.log2(Math.max(b.width,b.height))+1:T.mipmaps.length>0?T.mipmaps.length:T.isCompressedTexture&&Array.isArray(T.image)?b.mipmaps.length:1}function U(T){let b=new WeakRef(T);i.get(T).__ref=b,g.add(b),_.register(T,b,b)}function C(T){let b=i.get(T).__ref;b!==void 0&&(g.delete(b),_.unregister(b))}function L(T){B(T.target)}function I(T){R(T.target)}function B(T){T.removeEventListener("dispose",L),C(T),q(T),T.isVideoTexture&&h.delete(T),T.isHTMLTexture&&u.delete(T)}function R(T){T.removeEventListener("dispose",I),C(T),K(T)}function W(){for(let T of g){let b=T.deref();b!==void 0&&(b.isRenderTarget===!0?R(b):B(b))}g.clear(),u.clear()}function q(T){let b=i.get(T);if(b.__webglInit===void 0)return;let V=T.source,at=d.get(V);if(at){let nt=at[b.__cacheKey];nt.usedTimes--,nt.usedTimes===0&&H(T),Object.keys(at).length===0&&d.delete(V)}i.remove(T)}function H(T){let b=i.get(T);n.deleteTexture(b.__webglTexture);let V=T.source,at=d.get(V);delete at[b.__cacheKey],o.memory.textures--}function K(T){let b=i.get(T);b.__depthDisposeCallback&&b.__depthDisposeCallback();let V=T.depthTexture;if(V&&V.renderTarget===T&&B(V),T.isWebGLCubeRenderTarget)for(let nt=0;nt<6;nt++){if(Array.isArray(b.__webglFramebuffer[nt]))for(let ht=0;ht<b.__webglFramebuffer[nt].length;ht++)n.deleteFramebuffer(b.__webglFramebuffer[nt][ht]);else n.deleteFramebuffer(b.__webglFramebuffer[nt]);b.__webglDepthbuffer&&n.deleteRenderbuffer(b.__webglDepthbuffer[nt])}else{if(Array.isArray(b.__webglFramebuffer))for(let nt=0;nt<b.__webglFramebuffer.length;nt++)n.deleteFramebuffer(b.__webglFramebuffer[nt]);else n.deleteFramebuffer(b.__webglFramebuffer);if(b.__webglDepthbuffer&&n.deleteRenderbuffer(b.__webglDepthbuffer),b.__webglMultisampledFramebuffer&&n.deleteFramebuffer(b.__webglMultisampledFramebuffer),b.__webglColorRenderbuffer)for(let nt=0;nt<b.__webglColorRenderbuffer.length;nt++)b.__webglColorRenderbuffer[nt]&&n.deleteRenderbuffer(b.__webglColorRenderbuffer[nt]);b.__webglDepthRenderbuffer&&n.deleteRenderbuffer(b.__webglDepthRenderbuffer)}let at=T.textures;for(let nt=0,ht=at.length;nt<ht;nt++){let mt=i.get(at[nt]);mt.__webglTexture&&(n.deleteTexture(mt.__webglTexture),o.memory.textures--),i.remove(at[nt])}i.remove(T)}let X=0;function Y(){X=0}function rt(){return X}function Z(T){X=T}function ot(){let T=X;return T>=s.maxTextures&&It("WebGLTextures: Trying to use "+(T+1)+" texture units while this GPU supports only "+s.maxTextures),X+=1,T}function z(T){let b=[];return b.push(T.wrapS),b.push(T.wrapT),b.push(T.wrapR||0),b.push(T.magFilter),b.push(T.minFilter),b.push(T.anisotropy),b.push(T.internalFormat),b.push(T.format),b.push(T.type),b.push(T.generateMipmaps),b.push(T.mipmapsAutoUpdate),b.push(T.premultiplyAlpha),b.push(T.flipY),b.push(T.unpackAlignment),b.push(T.colorSpace),b.join()}function it(T,b){let V=i.get(T);if(T.isVideoTexture&&be(T),T.isRenderTargetTexture===!1&&T.isExternalTexture!==!0&&T.version>0&&V.__version!==T.version){let at=T.image;if(at===null)It("WebGLRenderer: Texture marked for update but no image data found.");else if(at.complete===!1)It("WebGLRenderer: Texture marked for update but image is incomplete");else{jt(V,T,b);return}}else T.isExternalTexture&&(V.__webglTexture=T.sourceTexture?T.sourceTexture:null);e.bindTexture(n.TEXTURE_2D,V.__webglTexture,n.TEXTURE0+b)}function F(T,b){let V=i.get(T);if(T.isRenderTargetTexture===!1&&T.version>0&&V.__version!==T.version){jt(V,T,b);return}else T.isExternalTexture&&(V.__webglTexture=T.sourceTexture?T.sourceTexture:null);e.bindTexture(n.TEXTURE_2D_ARRAY,V.__webglTexture,n.TEXTURE0+b)}function et(T,b){let V=i.get(T);if(T.isRenderTargetTexture===!1&&T.version>0&&V.__version!==T.version){jt(V,T,b);return}e.bindTexture(n.TEXTURE_3D,V.__webglTexture,n.TEXTURE0+b)}function st(T,b){let V=i.get(T);if(T.version>0&&V.__version!==T.version){ve(V,T,b);return}e.bindTexture(n.TEXTURE_CUBE_MAP,V.__webglTexture,n.TEXTURE0+b)}let Mt={[Tl]:n.REPEAT,[Yn]:n.CLAMP_TO_EDGE,[Cl]:n.MIRRORED_REPEAT},Wt={[Ie]:n.NEAREST,[Lg]:n.NEAREST_MIPMAP_NEAREST,[ko]:n.NEAREST_MIPMAP_LINEAR,[Qe]:n.LINEAR,[ic]:n.LINEAR_MIPMAP_NEAREST,[wi]:n.LINEAR_MIPMAP_LINEAR},yt={[Og]:n.NEVER,[pf]:n.ALWAYS,[Fg]:n.LESS,[ff]:n.LEQUAL,[Bg]:n.EQUAL,[df]:n.GEQUAL,[kg]:n.GREATER,[zg]:n.NOTEQUAL};function Nt(T,b){if(b.type===Bn&&t.has("OES_texture_float_linear")===!1&&(b.magFilter===Qe||b.magFilter===ic||b.magFilter===ko||b.magFilter===wi||b.minFilter===Qe||b.minFilter===ic||b.minFilter===ko||b.minFilter===wi)&&It("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),n.texParameteri(T,n.TEXTURE_WRAP_S,Mt[b.wrapS]),n.texParameteri(T,n.TEXTURE_WRAP_T,Mt[b.wrapT]),(T===n.TEXTURE_3D||T===n.TEXTURE_2D_ARRAY)&&n.texParameteri(T,n.TEXTURE_WRAP_R,Mt[b.wrapR]),n.texParameteri(T,n.TEXTURE_MAG_FILTER,Wt[b.magFilter]),n.texParameteri(T,n.TEXTURE_MIN_FILTER,Wt[b.minFilter]),b.compareFunction&&(n.texParameteri(T,n.TEXTURE_COMPARE_MODE,n.COMPARE_REF_TO_TEXTURE),n.texParameteri(T,n.TEXTURE_COMPARE_FUNC,yt[b.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(b.magFilter===Ie||b.minFilter!==ko&&b.minFilter!==wi||b.type===Bn&&t.has("OES_texture_float_linear")===!1)return;if(b.anisotropy>1||i.get(b).__currentAnisotropy){let V=t.get("EXT_texture_filter_anisotropic");n.texParameterf(T,V.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(b.anisotropy,s.getMaxAnisotropy())),i.get(b).__currentAnisotropy=b.anisotropy}}}function Ht(T,b){let V=!1;T.__webglInit===void 0&&(T.__webglInit=!0,b.addEventListener("dispose",L),U(b));let at=b.source,nt=d.get(at);nt===void 0&&(nt={},d.set(at,nt));let ht=z(b);if(ht!==T.__cacheKey){nt[ht]===void 0&&(nt[ht]={texture:n.createTexture(),usedTimes:0},o.memory.textures++,V=!0),nt[ht].usedTimes++;let mt=nt[T.__cacheKey];mt!==void 0&&(nt[T.__cacheKey].usedTimes--,mt.usedTimes===0&&H(b)),T.__cacheKey=ht,T.__webglTexture=nt[ht].texture}return V}function Ct(T,b,V){return Math.floor(Math.floor(T/V)/b)}function le(T,b,V,at){let ht=T.updateRanges;if(ht.length===0)e.texSubImage2D(n.TEXTURE_2D,0,0,0,b.width,b.height,V,at,b.data);else{ht.sort((P,tt)=>P.start-tt.start);let mt=0;for(let P=1;P<ht.length;P++){let tt=ht[mt],J=ht[P],dt=tt.start+tt.count,ct=Ct(J.start,b.width,4),ut=Ct(tt.start,b.width,4);J.start<=dt+1&&ct===ut&&Ct(J.start+J.count-1,b.width,4)===ct?tt.count=Math.max(tt.count,J.start+J.count-tt.start):(++mt,ht[mt]=J)}ht.length=mt+1;let j=e.getParameter(n.UNPACK_ROW_LENGTH),Q=e.getParameter(n.UNPACK_SKIP_PIXELS),ft=e.getParameter(n.UNPACK_SKIP_ROWS);e.pixelStorei(n.UNPACK_ROW_LENGTH,b.width);for(let P=0,tt=ht.length;P<tt;P++){let J=ht[P],dt=Math.floor(J.start/4),ct=Math.ceil(J.count/4),ut=dt%b.width,Tt=Math.floor(dt/b.width),Vt=ct,lt=1;e.pixelStorei(n.UNPACK_SKIP_PIXELS,ut),e.pixelStorei(n.UNPACK_SKIP_ROWS,Tt),e.texSubImage2D(n.TEXTURE_2D,0,ut,Tt,Vt,lt,V,at,b.data)}T.clearUpdateRanges(),e.pixelStorei(n.UNPACK_ROW_LENGTH,j),e.pixelStorei(n.UNPACK_SKIP_PIXELS,Q),e.pixelStorei(n.UNPACK_SKIP_ROWS,ft)}}function jt(T,b,V){let at=n.TEXTURE_2D;(b.isDataArrayTexture||b.isCompressedArrayTexture)&&(at=n.TEXTURE_2D_ARRAY),b.isData3DTexture&&(at=n.TEXTURE_3D);let nt=Ht(T,b),ht=b.source;e.bindTexture(at,T.__webglTexture,n.TEXTURE0+V);let mt=i.get(ht);if(ht.version!==mt.__version||nt===!0){if(e.activeTexture(n.TEXTURE0+V),(typeof ImageBitmap<"u"&&b.image instanceof ImageBitmap)===!1){let lt=Yt.getPrimaries(Yt.workingColorSpace),Pt=b.colorSpace===Ai?null:Yt.getPrimaries(b.colorSpace),kt=b.colorSpace===Ai||lt===Pt?n.NONE:n.BROWSER_DEFAULT_WEBGL;e.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,b.flipY),e.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,b.premultiplyAlpha),e.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,kt)}e.pixelStorei(n.UNPACK_ALIGNMENT,b.unpackAlignment);let Q=y(b.image,!1,s.maxTextureSize);Q=Lt(b,Q);let ft=r.convert(b.format,b.colorSpace),P=r.convert(b.type),tt=E(b.internalFormat,ft,P,b.normalized,b.colorSpace,b.isVideoTexture);Nt(at,b);let J,dt=b.mipmaps,ct=b.isVideoTexture!==!0,ut=mt.__version===void 0||nt===!0,Tt=ht.dataReady,Vt=w(b,Q);if(b.isDepthTexture)tt=x(b.format===Ei,b.type),ut&&(ct?e.texStorage2D(n.TEXTURE_2D,1,tt,Q.width,Q.height):e.texImage2D(n.TEXTURE_2D,0,tt,Q.width,Q.height,0,ft,P,null));else if(b.isDataTexture)if(dt.length>0){ct&&ut&&e.texStorage2D(n.TEXTURE_2D,Vt,tt,dt[0].width,dt[0].height);for(let lt=0,Pt=dt.length;lt<Pt;lt++)J=dt[lt],ct?Tt&&e.texSubImage2D(n.TEXTURE_2D,lt,0,0,J.width,J.height,ft,P,J.data):e.texImage2D(n.TEXTURE_2D,lt,tt,J.width,J.height,0,ft,P,J.data);b.generateMipmaps=!1}else ct?(ut&&e.texStorage2D(n.TEXTURE_2D,Vt,tt,Q.width,Q.height),Tt&&le(b,Q,ft,P)):e.texImage2D(n.TEXTURE_2D,0,tt,Q.width,Q.height,0,ft,P,Q.data);else if(b.isCompressedTexture)if(b.isCompressedArrayTexture){ct&&ut&&e.texStorage3D(n.TEXTURE_2D_ARRAY,Vt,tt,dt[0].width,dt[0].height,Q.depth);for(let lt=0,Pt=dt.length;lt<Pt;lt++)if(J=dt[lt],b.format!==zn)if(ft!==null)if(ct){if(Tt)if(b.layerUpdates.size>0){let kt=wf(J.width,J.height,b.format,b.type);for(let vt of b.layerUpdates){let ie=J.data.subarray(vt*kt/J.data.BYTES_PER_ELEMENT,(vt+1)*kt/J.data.BYTES_PER_ELEMENT);e.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,lt,0,0,vt,J.width,J.height,1,ft,ie)}}else e.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,lt,0,0,0,J.width,J.height,Q.depth,ft,J.data)}else e.compressedTexImage3D(n.TEXTURE_2D_ARRAY,lt,tt,J.width,J.height,Q.depth,0,J.data,0,0);else It("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else ct?Tt&&e.texSubImage3D(n.TEXTURE_2D_ARRAY,lt,0,0,0,J.width,J.height,Q.depth,ft,P,J.data):e.texImage3D(n.TEXTURE_2D_ARRAY,lt,tt,J.width,J.height,Q.depth,0,ft,P,J.data);b.layerUpdates.size>0&&b.clearLayerUpdates()}else{ct&&ut&&e.texStorage2D(n.TEXTURE_2D,Vt,tt,dt[0].width,dt[0].height);for(let lt=0,Pt=dt.length;lt<Pt;lt++)J=dt[lt],b.format!==zn?ft!==null?ct?Tt&&e.compressedTexSubImage2D(n.TEXTURE_2D,lt,0,0,J.width,J.height,ft,J.data):e.compressedTexImage2D(n.TEXTURE_2D,lt,tt,J.width,J.height,0,J.data):It("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):ct?Tt&&e.texSubImage2D(n.TEXTURE_2D,lt,0,0,J.width,J.height,ft,P,J.data):e.texImage2D(n.TEXTURE_2D,lt,tt,J.width,J.height,0,ft,P,J.data)}else if(b.isDataArrayTexture)if(ct){if(ut&&e.texStorage3D(n.TEXTURE_2D_ARRAY,Vt,tt,Q.width,Q.height,Q.depth),Tt)if(b.layerUpdates.size>0){let lt=wf(Q.width,Q.height,b.format,b.type);for(let Pt of b.layerUpdates){let kt=Q.data.subarray(Pt*lt/Q.data.BYTES_PER_ELEMENT,(Pt+1)*lt/Q.data.BYTES_PER_ELEMENT);e.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,Pt,Q.width,Q.height,1,ft,P,kt)}b.clearLayerUpdates()}else e.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,0,Q.width,Q.height,Q.depth,ft,P,Q.data)}else e.texImage3D(n.TEXTURE_2D_ARRAY,0,tt,Q.width,Q.height,Q.depth,0,ft,P,Q.data);else if(b.isData3DTexture)ct?(ut&&e.texStorage3D(n.TEXTURE_3D,Vt,tt,Q.width,Q.height,Q.depth),Tt&&e.texSubImage3D(n.TEXTURE_3D,0,0,0,0,Q.width,Q.height,Q.depth,ft,P,Q.data)):e.texImage3D(n.TEXTURE_3D,0,tt,Q.width,Q.height,Q.depth,0,ft,P,Q.data);else if(b.isFramebufferTexture){if(ut)if(ct)e.texStorage2D(n.TEXTURE_2D,Vt,tt,Q.width,Q.height);else{let lt=Q.width,Pt=Q.height;for(let kt=0;kt<Vt;kt++)e.texImage2D(n.TEXTURE_2D,kt,tt,lt,Pt,0,ft,P,null),lt>>=1,Pt>>=1}}else if(b.isHTMLTexture){if("texElementImage2D"in n){let lt=n.canvas;if(lt.hasAttribute("layoutsubtree")||lt.setAttribute("layoutsubtree","true"),Q.parentNode!==lt){lt.appendChild(Q),u.add(b),lt.onpaint=Pt=>{let kt=Pt.changedElements;for(let vt of u)kt.includes(vt.image)&&(vt.needsUpdate=!0)},lt.requestPaint();return}if(n.texElementImage2D.length===3)n.texElementImage2D(n.TEXTURE_2D,n.RGBA8,Q);else{let kt=n.RGBA,vt=n.RGBA,ie=n.UNSIGNED_BYTE;n.texElementImage2D(n.TEXTURE_2D,0,kt,vt,ie,Q)}n.texParameteri(n.TEXTURE_2D,n.TEXTURE_MIN_FILTER,n.LINEAR),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_S,n.CLAMP_TO_EDGE),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_T,n.CLAMP_TO_EDGE)}}else if(dt.length>0){if(ct&&ut){let lt=Ot(dt[0]);e.texStorage2D(n.TEXTURE_2D,Vt,tt,lt.width,lt.height)}for(let lt=0,Pt=dt.length;lt<Pt;lt++)J=dt[lt],ct?Tt&&e.texSubImage2D(n.TEXTURE_2D,lt,0,0,ft,P,J):e.texImage2D(n.TEXTURE_2D,lt,tt,ft,P,J);b.generateMipmaps=!1}else if(ct){if(ut){let lt=Ot(Q);e.texStorage2D(n.TEXTURE_2D,Vt,tt,lt.width,lt.height)}Tt&&e.texSubImage2D(n.TEXTURE_2D,0,0,0,ft,P,Q)}else e.texImage2D(n.TEXTURE_2D,0,tt,ft,P,Q);S(b)&&b.mipmapsAutoUpdate===!0&&v(at),mt.__version=ht.version,b.onUpdate&&b.onUpdate(b)}T.__version=b.version}function ve(T,b,V){if(b.image.length!==6)return;let at=Ht(T,b),nt=b.source;e.bindTexture(n.TEXTURE_CUBE_MAP,T.__webglTexture,n.TEXTURE0+V);let ht=i.get(nt);if(nt.version!==ht.__version||at===!0){e.activeTexture(n.TEXTURE0+V);let mt=Yt.getPrimaries(Yt.workingColorSpace),j=b.colorSpace===Ai?null:Yt.getPrimaries(b.colorSpace),Q=b.colorSpace===Ai||mt===j?n.NONE:n.BROWSER_DEFAULT_WEBGL;e.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,b.flipY),e.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,b.premultiplyAlpha),e.pixelStorei(n.UNPACK_ALIGNMENT,b.unpackAlignment),e.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,Q);let ft=b.isCompressedTexture||b.image[0].isCompressedTexture,P=b.image[0]&&b.image[0].isDataTexture,tt=[];for(let vt=0;vt<6;vt++)!ft&&!P?tt[vt]=y(b.image[vt],!0,s.maxCubemapSize):tt[vt]=P?b.image[vt].image:b.image[vt],tt[vt]=Lt(b,tt[vt]);let J=tt[0],dt=r.convert(b.format,b.colorSpace),ct=r.convert(b.type),ut=E(b.internalFormat,dt,ct,b.normalized,b.colorSpace),Tt=b.isVideoTexture!==!0,Vt=ht.__version===void 0||at===!0,lt=nt.dataReady,Pt=w(b,J);Nt(n.TEXTURE_CUBE_MAP,b);let kt;if(b.isDepthTexture){if(ut=x(b.format===Ei,b.type),Vt)if(Tt)e.texStorage2D(n.TEXTURE_CUBE_MAP,1,ut,J.width,J.height);else for(let vt=0;vt<6;vt++)e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,ut,J.width,J.height,0,dt,ct,null)}else if(ft){Tt&&Vt&&e.texStorage2D(n.TEXTURE_CUBE_MAP,Pt,ut,J.width,J.height);for(let vt=0;vt<6;vt++){kt=tt[vt].mipmaps;for(let ie=0;ie<kt.length;ie++){let Ae=kt[ie];b.format!==zn?dt!==null?Tt?lt&&e.compressedTexSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ie,0,0,Ae.width,Ae.height,dt,Ae.data):e.compressedTexImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ie,ut,Ae.width,Ae.height,0,Ae.data):It("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Tt?lt&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ie,0,0,Ae.width,Ae.height,dt,ct,Ae.data):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ie,ut,Ae.width,Ae.height,0,dt,ct,Ae.data)}}}else{if(kt=b.mipmaps,Tt&&Vt){kt.length>0&&Pt++;let vt=Ot(tt[0]);e.texStorage2D(n.TEXTURE_CUBE_MAP,Pt,ut,vt.width,vt.height)}for(let vt=0;vt<6;vt++)if(P){Tt?lt&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,0,0,tt[vt].width,tt[vt].height,dt,ct,tt[vt].data):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,ut,tt[vt].width,tt[vt].height,0,dt,ct,tt[vt].data);for(let ie=0;ie<kt.length;ie++){let Ti=kt[ie].image[vt].image;Tt?lt&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ie+1,0,0,Ti.width,Ti.height,dt,ct,Ti.data):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ie+1,ut,Ti.width,Ti.height,0,dt,ct,Ti.data)}}else{Tt?lt&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,0,0,dt,ct,tt[vt]):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,ut,dt,ct,tt[vt]);for(let ie=0;ie<kt.length;ie++){let Ae=kt[ie];Tt?lt&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ie+1,0,0,dt,ct,Ae.image[vt]):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ie+1,ut,dt,ct,Ae.image[vt])}}}S(b)&&b.mipmapsAutoUpdate===!0&&v(n.TEXTURE_CUBE_MAP),ht.__version=nt.version,b.onUpdate&&b.onUpdate(b)}T.__version=b.version}function me(T,b,V,at,nt,ht){let mt=r.convert(V.format,V.colorSpace),j=r.convert(V.type),Q=E(V.internalFormat,mt,j,V.normalized,V.colorSpace),ft=i.get(b),P=i.get(V);if(P.__renderTarget=b,!ft.__hasExternalTextures){let tt=Math.max(1,b.width>>ht),J=Math.max(1,b.height>>ht);nt===n.TEXTURE_3D||nt===n.TEXTURE_2D_ARRAY?e.texImage3D(nt,ht,Q,tt,J,b.depth,0,mt,j,null):e.texImage2D(nt,ht,Q,tt,J,0,mt,j,null)}e.bindFramebuffer(n.FRAMEBUFFER,T),xt(b)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,at,nt,P.__webglTexture,0,de(b)):(nt===n.TEXTURE_2D||nt>=n.TEXTURE_CUBE_MAP_POSITIVE_X&&nt<=n.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&n.framebufferTexture2D(n.FRAMEBUFFER,at,nt,P.__webglTexture,ht),e.bindFramebuffer(n.FRAMEBUFFER,null)}function Vn(T,b,V){if(n.bindRenderbuffer(n.RENDERBUFFER,T),b.depthBuffer){let at=b.depthTexture,nt=at&&at.isDepthTexture?at.type:null,ht=x(b.stencilBuffer,nt),mt=b.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;xt(b)?a.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,de(b),ht,b.width,b.height):V?n.renderbufferStorageMultisample(n.RENDERBUFFER,de(b),ht,b.width,b.height):n.renderbufferStorage(n.RENDERBUFFER,ht,b.width,b.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,mt,n.RENDERBUFFER,T)}else{let at=b.textures;for(let nt=0;nt<at.length;nt++){let ht=at[nt],mt=r.convert(ht.format,ht.colorSpace),j=r.convert(ht.type),Q=E(ht.internalFormat,mt,j,ht.normalized,ht.colorSpace);xt(b)?a.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,de(b),Q,b.width,b.height):V?n.renderbufferStorageMultisample(n.RENDERBUFFER,de(b),Q,b.width,b.height):n.renderbufferStorage(n.RENDERBUFFER,Q,b.width,b.height)}}n.bindRenderbuffer(n.RENDERBUFFER,null)}function Ee(T,b,V){let at=b.isWebGLCubeRenderTarget===!0;if(e.bindFramebuffer(n.FRAMEBUFFER,T),!(b.depthTexture&&b.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let nt=i.get(b.depthTexture);nt.__renderTarget=b;let ht=at?b.depthTexture.image[0]:b.depthTexture.image;(!nt.__webglTexture||ht.width!==b.width||ht.height!==b.height)&&(ht.width=b.width,ht.height=b.height,b.depthTexture.needsUpdate=!0),at?st(b.depthTexture,0):it(b.depthTexture,0);let mt=nt.__webglTexture,j=de(b),Q=at?n.TEXTURE_CUBE_MAP_POSITIVE_X+V:n.TEXTURE_2D,ft=b.depthTexture.format===Ei?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;if(b.depthTexture.format===xi)xt(b)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,ft,Q,mt,0,j):n.framebufferTexture2D(n.FRAMEBUFFER,ft,Q,mt,0);else if(b.depthTexture.format===Ei)xt(b)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,ft,Q,mt,0,j):n.framebufferTexture2D(n.FRAMEBUFFER,ft,Q,mt,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function mn(T){let b=i.get(T),V=T.isWebGLCubeRenderTarget===!0;if(b.__boundDepthTexture!==T.depthTexture){let at=T.depthTexture;if(b.__depthDisposeCallback&&b.__depthDisposeCallback(),at){let nt=()=>{delete b.__boundDepthTexture,delete b.__depthDisposeCallback,at.removeEventListener("dispose",nt)};at.addEventListener("dispose",nt),b.__depthDisposeCallback=nt}b.__boundDepthTexture=at}if(T.depthTexture&&!b.__autoAllocateDepthBuffer)if(V)for(let at=0;at<6;at++)Ee(b.__webglFramebuffer[at],T,at);else T.texture.mipmaps.length>0?Ee(b.__webglFramebuffer[0],T,0):Ee(b.__webglFramebuffer,T,0);else if(V){b.__webglDepthbuffer=[];for(let at=0;at<6;at++)if(e.bindFramebuffer(n.FRAMEBUFFER,b.__webglFramebuffer[at]),b.__webglDepthbuffer[at]===void 0)b.__webglDepthbuffer[at]=n.createRenderbuffer(),Vn(b.__webglDepthbuffer[at],T,!1);else{let nt=T.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,ht=b.__webglDepthbuffer[at];n.bindRenderbuffer(n.RENDERBUFFER,ht),n.framebufferRenderbuffer(n.FRAMEBUFFER,nt,n.RENDERBUFFER,ht)}}else if(T.texture.mipmaps.length>0?e.bindFramebuffer(n.FRAMEBUFFER,b.__webglFramebuffer[0]):e.bindFramebuffer(n.FRAMEBUFFER,b.__webglFramebuffer),b.__webglDepthbuffer===void 0)b.__webglDepthbuffer=n.createRenderbuffer(),Vn(b.__webglDepthbuffer,T,!1);else{let nt=T.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,ht=b.__webglDepthbuffer;n.bindRenderbuffer(n.RENDERBUFFER,ht),n.framebufferRenderbuffer(n.FRAMEBUFFER,nt,n.RENDERBUFFER,ht)}e.bindFramebuffer(n.FRAMEBUFFER,null)}function gn(T,b,V){let at=i.get(T);b!==void 0&&me(at.__webglFramebuffer,T,T.texture,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,0),V!==void 0&&mn(T)}function _n(T){let b=T.texture,V=i.get(T),at=i.get(b);T.addEventListener("dispose",I),U(T);let nt=T.textures,ht=T.isWebGLCubeRenderTarget===!0,mt=nt.length>1;if(mt||(at.__webglTexture===void 0&&(at.__webglTexture=n.createTexture()),at.__version=b.version,o.memory.textures++),ht){V.__webglFramebuffer=[];for(let j=0;j<6;j++)if(b.mipmaps.length>0){V.__webglFramebuffer[j]=[];for(let Q=0;Q<b.mipmaps.length;Q++)V.__webglFramebuffer[j][Q]=n.createFramebuffer()}else V.__webglFramebuffer[j]=n.createFramebuffer()}else{if(b.mipmaps.length>0){V.__webglFramebuffer=[];for(let j=0;j<b.mipmaps.length;j++)V.__webglFramebuffer[j]=n.createFramebuffer()}else V.__webglFramebuffer=n.createFramebuffer();if(mt)for(let j=0,Q=nt.length;j<Q;j++){let ft=i.get(nt[j]);ft.__webglTexture===void 0&&(ft.__webglTexture=n.createTexture(),o.memory.textures++)}if(T.samples>0&&xt(T)===!1){V.__webglMultisampledFramebuffer=n.createFramebuffer(),V.__webglColorRenderbuffer=[],e.bindFramebuffer(n.FRAMEBUFFER,V.__webglMultisampledFramebuffer);for(let j=0;j<nt.length;j++){let Q=nt[j];V.__webglColorRenderbuffer[j]=n.createRenderbuffer(),n.bindRenderbuffer(n.RENDERBUFFER,V.__webglColorRenderbuffer[j]);let ft=r.convert(Q.format,Q.colorSpace),P=r.convert(Q.type),tt=E(Q.internalFormat,ft,P,Q.normalized,Q.colorSpace,T.isXRRenderTarget===!0),J=de(T);n.renderbufferStorageMultisample(n.RENDERBUFFER,J,tt,T.width,T.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+j,n.RENDERBUFFER,V.__webglColorRenderbuffer[j])}n.bindRenderbuffer(n.RENDERBUFFER,null),T.depthBuffer&&(V.__webglDepthRenderbuffer=n.createRenderbuffer(),Vn(V.__webglDepthRenderbuffer,T,!0)),e.bindFramebuffer(n.FRAMEBUFFER,null)}}if(ht){e.bindTexture(n.TEXTURE_CUBE_MAP,at.__webglTexture),Nt(n.TEXTURE_CUBE_MAP,b);for(let j=0;j<6;j++)if(b.mipmaps.length>0)for(let Q=0;Q<b.mipmaps.length;Q++)me(V.__webglFramebuffer[j][Q],T,b,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+j,Q);else me(V.__webglFramebuffer[j],T,b,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+j,0);S(b)?v(n.TEXTURE_CUBE_MAP):b.mipmaps.length>0&&n.texParameteri(n.TEXTURE_CUBE_MAP,n.TEXTURE_MAX_LEVEL,b.mipmaps.length-1),e.unbindTexture()}else if(mt){for(let j=0,Q=nt.length;j<Q;j++){let ft=nt[j],P=i.get(ft),tt=n.TEXTURE_2D;(T.isWebGL3DRenderTarget||T.isWebGLArrayRenderTarget)&&(tt=T.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),e.bindTexture(tt,P.__webglTexture),Nt(tt,ft),me(V.__webglFramebuffer,T,ft,n.COLOR_ATTACHMENT0+j,tt,0),S(ft)&&v(tt)}e.unbindTexture()}else{let j=n.TEXTURE_2D;if((T.isWebGL3DRenderTarget||T.isWebGLArrayRenderTarget)&&(j=T.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),e.bindTexture(j,at.__webglTexture),Nt(j,b),b.mipmaps.length>0)for(let Q=0;Q<b.mipmaps.length;Q++)me(V.__webglFramebuffer[Q],T,b,n.COLOR_ATTACHMENT0,j,Q);else me(V.__webglFramebuffer,T,b,n.COLOR_ATTACHMENT0,j,0);S(b)?v(j):b.mipmaps.length>0&&n.texParameteri(j,n.TEXTURE_MAX_LEVEL,b.mipmaps.length-1),e.unbindTexture()}T.depthBuffer&&mn(T)}function O(T){let b=T.textures;for(let V=0,at=b.length;V<at;V++){let nt=b[V];if(S(nt)&&nt.mipmapsAutoUpdate===!0){let ht=A(T),mt=i.get(nt).__webglTexture;e.bindTexture(ht,mt),v(ht),e.unbindTexture()}}}let xn=[];function fe(T){if(T.samples>0){if(xt(T)===!1){let b=T.textures,V=T.width,at=T.height,nt=n.COLOR_BUFFER_BIT,ht=T.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,mt=i.get(T),j=b.length>1;if(j)for(let ft=0;ft<b.length;ft++)e.bindFramebuffer(n.FRAMEBUFFER,mt.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+ft,n.RENDERBUFFER,null),e.bindFramebuffer(n.FRAMEBUFFER,mt.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+ft,n.TEXTURE_2D,null,0);e.bindFramebuffer(n.READ_FRAMEBUFFER,mt.__webglMultisampledFramebuffer),T.texture.mipmaps.length>0?e.bindFramebuffer(n.DRAW_FRAMEBUFFER,mt.__webglFramebuffer[0]):e.bindFramebuffer(n.DRAW_FRAMEBUFFER,mt.__webglFramebuffer);for(let ft=0;ft<b.length;ft++){if(T.resolveDepthBuffer&&(T.depthBuffer&&(nt|=n.DEPTH_BUFFER_BIT),T.stencilBuffer&&T.resolveStencilBuffer&&(nt|=n.STENCIL_BUFFER_BIT)),j){n.framebufferRenderbuffer(n.READ_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.RENDERBUFFER,mt.__webglColorRenderbuffer[ft]);let P=i.get(b[ft]).__webglTexture;n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,P,0)}n.blitFramebuffer(0,0,V,at,0,0,V,at,nt,n.NEAREST),c===!0&&(xn.length=0,xn.push(n.COLOR_ATTACHMENT0+ft),T.depthBuffer&&T.storeMultisampledDepthBuffer===!1&&xn.push(ht),n.invalidateFramebuffer(n.READ_FRAMEBUFFER,xn))}if(e.bindFramebuffer(n.READ_FRAMEBUFFER,null),e.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),j)for(let ft=0;ft<b.length;ft++){e.bindFramebuffer(n.FRAMEBUFFER,mt.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+ft,n.RENDERBUFFER,mt.__webglColorRenderbuffer[ft]);let P=i.get(b[ft]).__webglTexture;e.bindFramebuffer(n.FRAMEBUFFER,mt.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+ft,n.TEXTURE_2D,P,0)}e.bindFramebuffer(n.DRAW_FRAMEBUFFER,mt.__webglMultisampledFramebuffer)}else if(T.depthBuffer&&T.storeMultisampledDepthBuffer===!1&&c){let b=T.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;n.invalidateFramebuffer(n.DRAW_FRAMEBUFFER,[b])}}}function de(T){return Math.min(s.maxSamples,T.samples)}function xt(T){let b=i.get(T);return T.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&b.__useRenderToTexture!==!1}function be(T){let b=o.render.frame;h.get(T)!==b&&(h.set(T,b),T.update())}function Lt(T,b){let V=T.colorSpace,at=T.format,nt=T.type;return T.isCompressedTexture===!0||T.isVideoTexture===!0||V!==fo&&V!==Ai&&(Yt.getTransfer(V)===ee?(at!==zn||nt!==ln)&&It("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):Dt("WebGLTextures: Unsupported texture color space:",V)),b}function Ot(T){return typeof HTMLImageElement<"u"&&T instanceof HTMLImageElement?(l.width=T.naturalWidth||T.width,l.height=T.naturalHeight||T.height):typeof VideoFrame<"u"&&T instanceof VideoFrame?(l.width=T.displayWidth,l.height=T.displayHeight):(l.width=T.width,l.height=T.height),l}this.allocateTextureUnit=ot,this.resetTextureUnits=Y,this.getTextureUnits=rt,this.setTextureUnits=Z,this.setTexture2D=it,this.setTexture2DArray=F,this.setTexture3D=et,this.setTextureCube=st,this.rebindTextures=gn,this.setupRenderTarget=_n,this.updateRenderTargetMipmap=O,this.updateMultisampleRenderTarget=fe,this.setupDepthRenderbuffer=mn,this.setupFrameBufferTexture=me,this.useMultisampledRTT=xt,this.dispose=W}function Z1(n,t){function e(i,s=Ai){let r,o=Yt.getTransfer(s);if(i===ln)return n.UNSIGNED_BYTE;if(i===rc)return n.UNSIGNED_SHORT_4_4_4_4;if(i===oc)return n.UNSIGNED_SHORT_5_5_5_1;if(i===af)return n.UNSIGNED_INT_5_9_9_9_REV;if(i===lf)return n.UNSIGNED_INT_10F_11F_11F_REV;if(i===rf)return n.BYTE;if(i===of)return n.SHORT;if(i===Pr)return n.UNSIGNED_SHORT;if(i===sc)return n.INT;if(i===Fn)return n.UNSIGNED_INT;if(i===Bn)return n.FLOAT;if(i===kn)return n.HALF_FLOAT;if(i===cf)return n.ALPHA;if(i===hf)return n.RGB;if(i===zn)return n.RGBA;if(i===xi)return n.DEPTH_COMPONENT;if(i===Ei)return n.DEPTH_STENCIL;if(i===uf)return n.RED;if(i===ac)return n.RED_INTEGER;if(i===Ji)return n.RG;if(i===lc)return n.RG_INTEGER;if(i===cc)return n.RGBA_INTEGER;if(i===zo||i===Vo||i===Go||i===Ho)if(o===ee)if(r=t.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(i===zo)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(i===Vo)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(i===Go)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(i===Ho)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=t.get("WEBGL_compressed_texture_s3tc"),r!==null){if(i===zo)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(i===Vo)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(i===Go)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(i===Ho)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(i===hc||i===uc||i===fc||i===dc)if(r=t.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(i===hc)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(i===uc)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(i===fc)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(i===dc)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(i===pc||i===mc||i===gc||i===_c||i===xc||i===Wo||i===yc)if(r=t.get("WEBGL_compressed_texture_etc"),r!==null){if(i===pc||i===mc)return o===ee?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(i===gc)return o===ee?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(i===_c)return r.COMPRESSED_R11_EAC;if(i===xc)return r.COMPRESSED_SIGNED_R11_EAC;if(i===Wo)return r.COMPRESSED_RG11_EAC;if(i===yc)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(i===vc||i===bc||i===Mc||i===Sc||i===wc||i===Ec||i===Ac||i===Tc||i===Cc||i===Rc||i===Pc||i===Ic||i===Lc||i===Nc)if(r=t.get("WEBGL_compressed_texture_astc"),r!==null){if(i===vc)return o===ee?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(i===bc)return o===ee?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(i===Mc)return o===ee?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(i===Sc)return o===ee?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(i===wc)return o===ee?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(i===Ec)return o===ee?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(i===Ac)return o===ee?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(i===Tc)return o===ee?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(i===Cc)return o===ee?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(i===Rc)return o===ee?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(i===Pc)return o===ee?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(i===Ic)return o===ee?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(i===Lc)return o===ee?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(i===Nc)return o===ee?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(i===Dc||i===Uc||i===Oc)if(r=t.get("EXT_texture_compression_bptc"),r!==null){if(i===Dc)return o===ee?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(i===Uc)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(i===Oc)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(i===Fc||i===Bc||i===Xo||i===kc)if(r=t.get("EXT_texture_compression_rgtc"),r!==null){if(i===Fc)return r.COMPRESSED_RED_RGTC1_EXT;if(i===Bc)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(i===Xo)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(i===kc)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return i===Rs?n.UNSIGNED_INT_24_8:n[i]!==void 0?n[i]:null}return{convert:e}}var J1=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,K1=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,Nf=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,e){if(this.texture===null){let i=new So(t.texture);(t.depthNear!==e.depthNear||t.depthFar!==e.depthFar)&&(this.depthNear=t.depthNear,this.depthFar=t.depthFar),this.texture=i}}getMesh(t){if(this.texture!==null&&this.mesh===null){let e=t.cameras[0].viewport,i=new Mn({vertexShader:J1,fragmentShader:K1,uniforms:{depthColor:{value:this.texture},depthWidth:{value:e.z},depthHeight:{value:e.w}}});this.mesh=new _e(new Ms(20,20),i)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},Df=class extends Nn{constructor(t,e){super();let i=this,s=null,r=1,o=null,a="local-floor",c=1,l=null,h=null,u=null,f=null,d=null,g=null,_=typeof XRWebGLBinding<"u",p=new Nf,m={},y=e.getContextAttributes(),S=null,v=null,A=[],E=[],x=new Rt,w=null,U=null,C=new je;C.viewport=new ne;let L=new je;L.viewport=new ne;let I=[C,L],B=new Ql,R=null,W=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(z){let it=A[z];return it===void 0&&(it=new Sr,A[z]=it),it.getTargetRaySpace()},this.getControllerGrip=function(z){let it=A[z];return it===void 0&&(it=new Sr,A[z]=it),it.getGripSpace()},this.getHand=function(z){let it=A[z];return it===void 0&&(it=new Sr,A[z]=it),it.getHandSpace()};function q(z){let it=E.indexOf(z.inputSource);if(it===-1)return;let F=A[it];F!==void 0&&(F.update(z.inputSource,z.frame,l||o),F.dispatchEvent({type:z.type,data:z.inputSource}))}function H(){s.removeEventListener("select",q),s.removeEventListener("selectstart",q),s.removeEventListener("selectend",q),s.removeEventListener("squeeze",q),s.removeEventListener("squeezestart",q),s.removeEventListener("squeezeend",q),s.removeEventListener("end",H),s.removeEventListener("inputsourceschange",K);for(let z=0;z<A.length;z++){let it=E[z];it!==null&&(E[z]=null,A[z].disconnect(it))}R=null,W=null,p.reset();for(let z in m)delete m[z];if(t.setRenderTarget(S),d=null,f=null,u=null,s=null,v=null,ot.stop(),i.isPresenting=!1,t.setPixelRatio(w),t.setSize(x.width,x.height,!1),U!==null){let z=U.camera;z.fov=U.fov,z.zoom=U.zoom,z.updateProjectionMatrix(),U=null}i.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(z){r=z,i.isPresenting===!0&&It("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(z){a=z,i.isPresenting===!0&&It("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return l||o},this.setReferenceSpace=function(z){l=z},this.getBaseLayer=function(){return f!==null?f:d},this.getBinding=function(){return u===null&&_&&(u=new XRWebGLBinding(s,e)),u},this.getFrame=function(){return g},this.getSession=function(){return s},this.setSession=async function(z){if(s=z,s!==null){if(S=t.getRenderTarget(),s.addEventListener("select",q),s.addEventListener("selectstart",q),s.addEventListener("selectend",q),s.addEventListener("squeeze",q),s.addEventListener("squeezestart",q),s.addEventListener("squeezeend",q),s.addEventListener("end",H),s.addEventListener("inputsourceschange",K),y.xrCompatible!==!0&&await e.makeXRCompatible(),w=t.getPixelRatio(),t.getSize(x),_&&"createProjectionLayer"in XRWebGLBinding.prototype){let F=null,et=null,st=null;y.depth&&(st=y.stencil?e.DEPTH24_STENCIL8:e.DEPTH_COMPONENT24,F=y.stencil?Ei:xi,et=y.stencil?Rs:Fn);let Mt={colorFormat:e.RGBA8,depthFormat:st,scaleFactor:r};u=this.getBinding(),f=u.createProjectionLayer(Mt),s.updateRenderState({layers:[f]}),t.setPixelRatio(1),t.setSize(f.textureWidth,f.textureHeight,!1),v=new fn(f.textureWidth,f.textureHeight,{format:zn,type:ln,depthTexture:new Mi(f.textureWidth,f.textureHeight,et,void 0,void 0,void 0,void 0,void 0,void 0,F),stencilBuffer:y.stencil,colorSpace:t.outputColorSpace,samples:y.antialias?4:0,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}else{let F={antialias:y.antialias,alpha:!0,depth:y.depth,stencil:y.stencil,framebufferScaleFactor:r};d=new XRWebGLLayer(s,e,F),s.updateRenderState({baseLayer:d}),t.setPixelRatio(1),t.setSize(d.framebufferWidth,d.framebufferHeight,!1),v=new fn(d.framebufferWidth,d.framebufferHeight,{format:zn,type:ln,colorSpace:t.outputColorSpace,stencilBuffer:y.stencil,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}v.isXRRenderTarget=!0,this.setFoveation(c),l=null,o=await s.requestReferenceSpace(a),ot.setContext(s),ot.start(),i.isPresenting=!0,i.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return p.getDepthTexture()};function K(z){for(let it=0;it<z.removed.length;it++){let F=z.removed[it],et=E.indexOf(F);et>=0&&(E[et]=null,A[et].disconnect(F))}for(let it=0;it<z.added.length;it++){let F=z.added[it],et=E.indexOf(F);if(et===-1){for(let Mt=0;Mt<A.length;Mt++)if(Mt>=E.length){E.push(F),et=Mt;break}else if(E[Mt]===null){E[Mt]=F,et=Mt;break}if(et===-1)break}let st=A[et];st&&st.connect(F)}}function X(z,it){it===null?z.matrixWorld.copy(z.matrix):z.matrixWorld.multiplyMatrices(it.matrixWorld,z.matrix),z.matrixWorldInverse.copy(z.matrixWorld).invert()}this.updateCamera=function(z){if(s===null)return;let it=z.near,F=z.far;p.texture!==null&&(p.depthNear>0&&(it=p.depthNear),p.depthFar>0&&(F=p.depthFar)),B.near=L.near=C.near=it,B.far=L.far=C.far=F,(R!==B.near||W!==B.far)&&(s.updateRenderState({depthNear:B.near,depthFar:B.far}),R=B.near,W=B.far),B.layers.mask=z.layers.mask|6,C.layers.mask=B.layers.mask&-5,L.layers.mask=B.layers.mask&-3;let et=z.parent,st=B.cameras;X(B,et);for(let Mt=0;Mt<st.length;Mt++)X(st[Mt],et);B.projectionMatrix.copy(C.projectionMatrix),B.projectionMatrixInverse.copy(C.projectionMatrixInverse),U===null&&z.isPerspectiveCamera&&(U={camera:z,fov:z.fov,zoom:z.zoom}),Y(z,B,et)};function Y(z,it,F){F===null?z.matrix.copy(it.matrixWorld):(z.matrix.copy(F.matrixWorld),z.matrix.invert(),z.matrix.multiply(it.matrixWorld)),z.matrix.decompose(z.position,z.quaternion,z.scale),z.updateMatrixWorld(!0),z.projectionMatrix.copy(it.projectionMatrix),z.projectionMatrixInverse.copy(it.projectionMatrixInverse),z.isPerspectiveCamera&&(z.fov=vr*2*Math.atan(1/z.projectionMatrix.elements[5]),z.zoom=1)}this.getCamera=function(){return B},this.getFoveation=function(){if(!(f===null&&d===null))return c},this.setFoveation=function(z){c=z,f!==null&&(f.fixedFoveation=z),d!==null&&d.fixedFoveation!==void 0&&(d.fixedFoveation=z)},this.hasDepthSensing=function(){return p.texture!==null},this.getDepthSensingMesh=function(){return p.getMesh(B)},this.getCameraTexture=function(z){return m[z]};let rt=null;function Z(z,it){if(h=it.getViewerPose(l||o),g=it,h!==null){let F=h.views;d!==null&&(t.setRenderTargetFramebuffer(v,d.framebuffer),t.setRenderTarget(v));let et=!1;F.length!==B.cameras.length&&(B.cameras.length=0,et=!0);for(let yt=0;yt<F.length;yt++){let Nt=F[yt],Ht=null;if(d!==null)Ht=d.getViewport(Nt);else{let le=u.getViewSubImage(f,Nt);Ht=le.viewport,yt===0&&(t.setRenderTargetTextures(v,le.colorTexture,le.depthStencilTexture),t.setRenderTarget(v))}let Ct=I[yt];Ct===void 0&&(Ct=new je,Ct.layers.enable(yt),Ct.viewport=new ne,I[yt]=Ct),Ct.matrix.fromArray(Nt.transform.matrix),Ct.matrix.decompose(Ct.position,Ct.quaternion,Ct.scale),Ct.projectionMatrix.fromArray(Nt.projectionMatrix),Ct.projectionMatrixInverse.copy(Ct.projectionMatrix).invert(),Ct.viewport.set(Ht.x,Ht.y,Ht.width,Ht.height),yt===0&&(B.matrix.copy(Ct.matrix),B.matrix.decompose(B.position,B.quaternion,B.scale)),et===!0&&B.cameras.push(Ct)}let st=s.enabledFeatures;if(st&&st.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&_){u=i.getBinding();let yt=u.getDepthInformation(F[0]);yt&&yt.isValid&&yt.texture&&p.init(yt,s.renderState)}if(st&&st.includes("camera-access")&&_){t.state.unbindTexture(),u=i.getBinding();for(let yt=0;yt<F.length;yt++){let Nt=F[yt].camera;if(Nt){let Ht=m[Nt];Ht||(Ht=new So,m[Nt]=Ht);let Ct=u.getCameraImage(Nt);Ht.sourceTexture=Ct}}}}for(let F=0;F<A.length;F++){let et=E[F],st=A[F];et!==null&&st!==void 0&&st.update(et,it,l||o)}rt&&rt(z,it),it.detectedPlanes&&i.dispatchEvent({type:"planesdetected",data:it}),g=null}let ot=new m0;ot.setAnimationLoop(Z),this.setAnimationLoop=function(z){rt=z},this.dispose=function(){}}},j1=new oe,E0=new Ut;E0.set(-1,0,0,0,1,0,0,0,1);function Q1(n,t){function e(p,m){p.matrixAutoUpdate===!0&&p.updateMatrix(),m.value.copy(p.matrix)}function i(p,m){m.color.getRGB(p.fogColor.value,bf(n)),m.isFog?(p.fogNear.value=m.near,p.fogFar.value=m.far):m.isFogExp2&&(p.fogDensity.value=m.density)}function s(p,m,y,S,v){m.isNodeMaterial?m.uniformsNeedUpdate=!1:m.isMeshBasicMaterial?r(p,m):m.isMeshLambertMaterial?(r(p,m),m.envMap&&(p.envMapIntensity.value=m.envMapIntensity)):m.isMeshToonMaterial?(r(p,m),u(p,m)):m.isMeshPhongMaterial?(r(p,m),h(p,m),m.envMap&&(p.envMapIntensity.value=m.envMapIntensity)):m.isMeshStandardMaterial?(r(p,m),f(p,m),m.isMeshPhysicalMaterial&&d(p,m,v)):m.isMeshMatcapMaterial?(r(p,m),g(p,m)):m.isMeshDepthMaterial?r(p,m):m.isMeshDistanceMaterial?(r(p,m),_(p,m)):m.isMeshNormalMaterial?r(p,m):m.isLineBasicMaterial?(o(p,m),m.isLineDashedMaterial&&a(p,m)):m.isPointsMaterial?c(p,m,y,S):m.isSpriteMaterial?l(p,m):m.isShadowMaterial?(p.color.value.copy(m.color),p.opacity.value=m.opacity):m.isShaderMaterial&&(m.uniformsNeedUpdate=!1)}function r(p,m){p.opacity.value=m.opacity,m.color&&p.diffuse.value.copy(m.color),m.emissive&&p.emissive.value.copy(m.emissive).multiplyScalar(m.emissiveIntensity),m.map&&(p.map.value=m.map,e(m.map,p.mapTransform)),m.alphaMap&&(p.alphaMap.value=m.alphaMap,e(m.alphaMap,p.alphaMapTransform)),m.bumpMap&&(p.bumpMap.value=m.bumpMap,e(m.bumpMap,p.bumpMapTransform),p.bumpScale.value=m.bumpScale,m.side===De&&(p.bumpScale.value*=-1)),m.normalMap&&(p.normalMap.value=m.normalMap,e(m.normalMap,p.normalMapTransform),p.normalScale.value.copy(m.normalScale),m.side===De&&p.normalScale.value.negate()),m.displacementMap&&(p.displacementMap.value=m.displacementMap,e(m.displacementMap,p.displacementMapTransform),p.displacementScale.value=m.displacementScale,p.displacementBias.value=m.displacementBias),m.emissiveMap&&(p.emissiveMap.value=m.emissiveMap,e(m.emissiveMap,p.emissiveMapTransform)),m.specularMap&&(p.specularMap.value=m.specularMap,e(m.specularMap,p.specularMapTransform)),m.alphaTest>0&&(p.alphaTest.value=m.alphaTest);let y=t.get(m),S=y.envMap,v=y.envMapRotation;S&&(p.envMap.value=S,p.envMapRotation.value.setFromMatrix4(j1.makeRotationFromEuler(v)).transpose(),S.isCubeTexture&&S.isRenderTargetTexture===!1&&p.envMapRotation.value.premultiply(E0),p.reflectivity.value=m.reflectivity,p.ior.value=m.ior,p.refractionRatio.value=m.refractionRatio),m.lightMap&&(p.lightMap.value=m.lightMap,p.lightMapIntensity.value=m.lightMapIntensity,e(m.lightMap,p.lightMapTransform)),m.aoMap&&(p.aoMap.value=m.aoMap,p.aoMapIntensity.value=m.aoMapIntensity,e(m.aoMap,p.aoMapTransform))}function o(p,m){p.diffuse.value.copy(m.color),p.opacity.value=m.opacity,m.map&&(p.map.value=m.map,e(m.map,p.mapTransform))}function a(p,m){p.dashSize.value=m.dashSize,p.totalSize.value=m.dashSize+m.gapSize,p.scale.value=m.scale}function c(p,m,y,S){p.diffuse.value.copy(m.color),p.opacity.value=m.opacity,p.size.value=m.size*y,p.scale.value=S*.5,m.map&&(p.map.value=m.map,e(m.map,p.uvTransform)),m.alphaMap&&(p.alphaMap.value=m.alphaMap,e(m.alphaMap,p.alphaMapTransform)),m.alphaTest>0&&(p.alphaTest.value=m.alphaTest)}function l(p,m){p.diffuse.value.copy(m.color),p.opacity.value=m.opacity,p.rotation.value=m.rotation,m.map&&(p.map.value=m.map,e(m.map,p.mapTransform)),m.alphaMap&&(p.alphaMap.value=m.alphaMap,e(m.alphaMap,p.alphaMapTransform)),m.alphaTest>0&&(p.alphaTest.value=m.alphaTest)}function h(p,m){p.specular.value.copy(m.specular),p.shininess.value=Math.max(m.shininess,1e-4)}function u(p,m){m.gradientMap&&(p.gradientMap.value=m.gradientMap)}function f(p,m){p.metalness.value=m.metalness,m.metalnessMap&&(p.metalnessMap.value=m.metalnessMap,e(m.metalnessMap,p.metalnessMapTransform)),p.roughness.value=m.roughness,m.roughnessMap&&(p.roughnessMap.value=m.roughnessMap,e(m.roughnessMap,p.roughnessMapTransform)),m.envMap&&(p.envMapIntensity.value=m.envMapIntensity)}function d(p,m,y){p.ior.value=m.ior,m.diffuseRoughness>0&&(p.diffuseRoughness.value=m.diffuseRoughness,m.diffuseRoughnessMap&&(p.diffuseRoughnessMap.value=m.diffuseRoughnessMap,e(m.diffuseRoughnessMap,p.diffuseRoughnessMapTransform))),m.sheen>0&&(p.sheenColor.value.copy(m.sheenColor).multiplyScalar(m.sheen),p.sheenRoughness.value=m.sheenRoughness,m.sheenColorMap&&(p.sheenColorMap.value=m.sheenColorMap,e(m.sheenColorMap,p.sheenColorMapTransform)),m.sheenRoughnessMap&&(p.sheenRoughnessMap.value=m.sheenRoughnessMap,e(m.sheenRoughnessMap,p.sheenRoughnessMapTransform))),m.clearcoat>0&&(p.clearcoat.value=m.clearcoat,p.clearcoatRoughness.value=m.clearcoatRoughness,m.clearcoatMap&&(p.clearcoatMap.value=m.clearcoatMap,e(m.clearcoatMap,p.clearcoatMapTransform)),m.clearcoatRoughnessMap&&(p.clearcoatRoughnessMap.value=m.clearcoatRoughnessMap,e(m.clearcoatRoughnessMap,p.clearcoatRoughnessMapTransform)),m.clearcoatNormalMap&&(p.clearcoatNormalMap.value=m.clearcoatNormalMap,e(m.clearcoatNormalMap,p.clearcoatNormalMapTransform),p.clearcoatNormalScale.value.copy(m.clearcoatNormalScale),m.side===De&&p.clearcoatNormalScale.value.negate())),m.dispersion>0&&(p.dispersion.value=m.dispersion),m.retroreflectivity>0&&(p.retroreflectivity.value=m.retroreflectivity),m.iridescence>0&&(p.iridescence.value=m.iridescence,p.iridescenceIOR.value=m.iridescenceIOR,p.iridescenceThicknessMinimum.value=m.iridescenceThicknessMinimum,p.iridescenceThicknessMaximum.value=m.iridescenceThicknessMaximum,m.iridescenceMap&&(p.iridescenceMap.value=m.iridescenceMap,e(m.iridescenceMap,p.iridescenceMapTransform)),m.iridescenceThicknessMap&&(p.iridescenceThicknessMap.value=m.iridescenceThicknessMap,e(m.iridescenceThicknessMap,p.iridescenceThicknessMapTransform))),m.transmission>0&&(p.transmission.value=m.transmission,p.transmissionSamplerMap.value=y.texture,p.transmissionSamplerSize.value.set(y.width,y.height),m.transmissionMap&&(p.transmissionMap.value=m.transmissionMap,e(m.transmissionMap,p.transmissionMapTransform)),p.thickness.value=m.thickness,m.thicknessMap&&(p.thicknessMap.value=m.thicknessMap,e(m.thicknessMap,p.thicknessMapTransform)),p.attenuationDistance.value=m.attenuationDistance,p.attenuationColor.value.copy(m.attenuationColor)),m.anisotropy>0&&(p.anisotropyVector.value.set(m.anisotropy*Math.cos(m.anisotropyRotation),m.anisotropy*Math.sin(m.anisotropyRotation)),m.anisotropyMap&&(p.anisotropyMap.value=m.anisotropyMap,e(m.anisotropyMap,p.anisotropyMapTransform))),p.specularIntensity.value=m.specularIntensity,p.specularColor.value.copy(m.specularColor),m.specularColorMap&&(p.specularColorMap.value=m.specularColorMap,e(m.specularColorMap,p.specularColorMapTransform)),m.specularIntensityMap&&(p.specularIntensityMap.value=m.specularIntensityMap,e(m.specularIntensityMap,p.specularIntensityMapTransform))}function g(p,m){m.matcap&&(p.matcap.value=m.matcap)}function _(p,m){let y=t.get(m).light;p.referencePosition.value.setFromMatrixPosition(y.matrixWorld),p.nearDistance.value=y.shadow.camera.near,p.farDistance.value=y.shadow.camera.far}return{refreshFogUniforms:i,refreshMaterialUniforms:s}}function tE(n,t,e,i){let s={},r={};function o(y,S){let v=S.program;i.uniformBlockBinding(y,v,s[y.id])}function a(y,S){let v=s[y.id];v===void 0&&(g(y),v=c(y),s[y.id]=v,y.addEventListener("dispose",p));let A=S.program;i.updateUBOMapping(y,A);let E=t.render.frame;r[y.id]!==E&&(l(y),r[y.id]=E)}function c(y){let S=n.createBuffer(),v=y.__size,A=y.usage;return n.bindBuffer(n.UNIFORM_BUFFER,S),n.bufferData(n.UNIFORM_BUFFER,v,A),n.bindBuffer(n.UNIFORM_BUFFER,null),S}function l(y){let S=s[y.id],v=y.uniforms,A=y.__cache;n.bindBuffer(n.UNIFORM_BUFFER,S);for(let E=0,x=v.length;E<x;E++){let w=v[E];if(Array.isArray(w))for(let U=0,C=w.length;U<C;U++)h(w[U],E,U,A);else h(w,E,0,A)}n.bindBuffer(n.UNIFORM_BUFFER,null)}function h(y,S,v,A){if(f(y,S,v,A)===!0){let E=y.__offset,x=y.value;if(Array.isArray(x)){let w=0;for(let U=0;U<x.length;U++){let C=x[U],L=_(C,!0);u(C,y.__data,w),w+=L.storage/Float32Array.BYTES_PER_ELEMENT}}else u(x,y.__data,0);n.bufferSubData(n.UNIFORM_BUFFER,E,y.__data)}}function u(y,S,v){typeof y=="number"||typeof y=="boolean"?S[v]=y:y.isMatrix3?(S[v]=y.elements[0],S[v+1]=y.elements[1],S[v+2]=y.elements[2],S[v+3]=0,S[v+4]=y.elements[3],S[v+5]=y.elements[4],S[v+6]=y.elements[5],S[v+7]=0,S[v+8]=y.elements[6],S[v+9]=y.elements[7],S[v+10]=y.elements[8],S[v+11]=0):ArrayBuffer.isView(y)?S.set(y.subarray(0,S.length-v),v):y.toArray(S,v)}function f(y,S,v,A){let E=y.value,x=S+"_"+v;if(Array.isArray(E)){A[x]===void 0&&(A[x]=[]);let w=A[x],U=!1;for(let C=0;C<E.length;C++)d(E[C],w,C)===!0&&(U=!0);return U}return d(E,A,x)}function d(y,S,v){if(S[v]===void 0)return typeof y=="number"||typeof y=="boolean"?S[v]=y:ArrayBuffer.isView(y)?S[v]=y.slice():S[v]=y.clone(),!0;{let A=S[v];if(typeof y=="number"||typeof y=="boolean"){if(A!==y)return S[v]=y,!0}else{if(ArrayBuffer.isView(y))return!0;if(A.equals(y)===!1)return A.copy(y),!0}}return!1}function g(y){let S=y.uniforms,v=0,A=16;for(let x=0,w=S.length;x<w;x++){let U=Array.isArray(S[x])?S[x]:[S[x]];for(let C=0,L=U.length;C<L;C++){let I=U[C],B=Array.isArray(I.value)?I.value:[I.value],R=Array.isArray(S[x])||Array.isArray(I.value),W=v;for(let H=0,K=B.length;H<K;H++){let X=B[H],Y=_(X,R),rt=v%A,Z=rt%Y.boundary,ot=rt+Z;v+=Z,ot!==0&&A-ot<Y.storage&&(v+=A-ot),H===0&&(W=v),v+=Y.storage}let q=I.type==="int"?Int32Array:I.type==="uint"?Uint32Array:Float32Array;I.__data=new q((v-W)/Float32Array.BYTES_PER_ELEMENT),I.__offset=W}}let E=v%A;return E>0&&(v+=A-E),y.__size=v,y.__cache={},this}function _(y,S){let v={boundary:0,storage:0};return typeof y=="number"||typeof y=="boolean"?(v.boundary=4,v.storage=4):y.isVector2?(v.boundary=8,v.storage=8):y.isVector3||y.isColor?(v.boundary=16,v.storage=12):y.isVector4?(v.boundary=16,v.storage=16):y.isMatrix3?(v.boundary=16,v.storage=48):y.isMatrix4?(v.boundary=16,v.storage=64):y.isTexture?It("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(y)?(v.boundary=16,v.storage=y.byteLength):It("WebGLRenderer: Unsupported uniform value type.",y),S===!0&&(v.boundary=16,v.storage=Math.ceil(v.storage/16)*16),v}function p(y){let S=y.target;S.removeEventListener("dispose",p),n.deleteBuffer(s[S.id]),delete s[S.id],delete r[S.id]}function m(){for(let y in s)n.deleteBuffer(s[y]);s={},r={}}return{bind:o,update:a,dispose:m}}var eE=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),Kn=null;function nE(){return Kn===null&&(Kn=new Dl(eE,16,16,Ji,kn),Kn.name="DFG_LUT",Kn.minFilter=Qe,Kn.magFilter=Qe,Kn.wrapS=Yn,Kn.wrapT=Yn,Kn.generateMipmaps=!1,Kn.needsUpdate=!0),Kn}var Xc=class{constructor(t={}){let{canvas:e=Vg(),context:i=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:c=!0,preserveDrawingBuffer:l=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:f=!1,outputBufferType:d=ln}=t;this.isWebGLRenderer=!0;let g;if(i!==null){if(typeof WebGLRenderingContext<"u"&&i instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");g=i.getContextAttributes().alpha}else g=o;let _=d,p=new Set([cc,lc,ac]),m=new Set([ln,Fn,Pr,Rs,rc,oc]),y=new Uint32Array(4),S=new Int32Array(4),v={textures:[],min:[],max:[],resolution:[]},A=null,E=null,x=[],w=[],U=null;this.domElement=e,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=Jn,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let C=this,L=!1,I=null,B=null,R=null,W=null;this._outputColorSpace=Je;let q=0,H=0,K=null,X=-1,Y=null,rt=new ne,Z=new ne,ot=null,z=new zt(0),it=0,F=e.width,et=e.height,st=1,Mt=null,Wt=null,yt=new ne(0,0,F,et),Nt=new ne(0,0,F,et),Ht=!1,Ct=new Vi,le=new Ul,jt=!1,ve=!1,me=new oe,Vn=new N,Ee=new ne,mn={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},gn=!1;function _n(){return K===null?st:1}let O=i;function xn(M,D){return e.getContext(M,D)}let fe,de,xt,be,Lt,Ot,T,b,V,at,nt,ht,mt,j,Q,ft,P,tt,J,dt,ct,ut,Tt;try{let M={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:c,preserveDrawingBuffer:l,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in e&&e.setAttribute("data-engine",`three.js r${"187"}`),e.addEventListener("webglcontextlost",Pt,!1),e.addEventListener("webglcontextrestored",kt,!1),e.addEventListener("webglcontextcreationerror",vt,!1),O===null){let D="webgl2";if(O=xn(D,M),O===null)throw xn(D)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}Vt()}catch(M){throw e.removeEventListener("webglcontextlost",Pt,!1),e.removeEventListener("webglcontextrestored",kt,!1),e.removeEventListener("webglcontextcreationerror",vt,!1),Dt("WebGLRenderer: "+M.message),M}function Vt(){fe=new dw(O),fe.init(),ct=new Z1(O,fe),de=new nw(O,fe,t,ct),xt=new q1(O,fe),de.reversedDepthBuffer&&f&&xt.buffers.depth.setReversed(!0),B=O.createFramebuffer(),R=O.createFramebuffer(),W=O.createFramebuffer(),be=new gw(O),Lt=new N1,Ot=new Y1(O,fe,xt,Lt,de,ct,be),T=new fw(C),b=new xb(O),ut=new tw(O,b),V=new pw(O,b,be,ut),at=new xw(O,V,b,ut,be),tt=new _w(O,de,Ot),Q=new iw(Lt),nt=new L1(C,T,fe,de,ut,Q),ht=new Q1(C,Lt),mt=new U1,j=new V1(fe),P=new QS(C,T,xt,at,g,c),ft=new $1(C,at,de),Tt=new tE(O,be,de,xt),J=new ew(O,fe,be),dt=new mw(O,fe,be),be.programs=nt.programs,C.capabilities=de,C.extensions=fe,C.properties=Lt,C.renderLists=mt,C.shadowMap=ft,C.state=xt,C.info=be}_!==ln&&(U=new vw(_,e.width,e.height,a,s,r));let lt=new Df(C,O);this.xr=lt,this.getContext=function(){return O},this.getContextAttributes=function(){return O.getContextAttributes()},this.forceContextLoss=function(){let M=fe.get("WEBGL_lose_context");M&&M.loseContext()},this.forceContextRestore=function(){let M=fe.get("WEBGL_lose_context");M&&M.restoreContext()},this.getPixelRatio=function(){return st},this.setPixelRatio=function(M){M!==void 0&&(st=M,this.setSize(F,et,!1))},this.getSize=function(M){return M.set(F,et)},this.setSize=function(M,D,$=!0){if(lt.isPresenting){It("WebGLRenderer: Can't change size while VR device is presenting.");return}F=M,et=D,e.width=Math.floor(M*st),e.height=Math.floor(D*st),$===!0&&(e.style.width=M+"px",e.style.height=D+"px"),U!==null&&U.setSize(e.width,e.height),this.setViewport(0,0,M,D)},this.getDrawingBufferSize=function(M){return M.set(F*st,et*st).floor()},this.setDrawingBufferSize=function(M,D,$){F=M,et=D,st=$,e.width=Math.floor(M*$),e.height=Math.floor(D*$),this.setViewport(0,0,M,D)},this.setEffects=function(M){if(_===ln){Dt("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(M){for(let D=0;D<M.length;D++)if(M[D].isOutputPass===!0){It("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}U.setEffects(M||[])},this.getCurrentViewport=function(M){return M.copy(rt)},this.getViewport=function(M){return M.copy(yt)},this.setViewport=function(M,D,$,k){M.isVector4?yt.set(M.x,M.y,M.z,M.w):yt.set(M,D,$,k),xt.viewport(rt.copy(yt).multiplyScalar(_n()).round())},this.getScissor=function(M){return M.copy(Nt)},this.setScissor=function(M,D,$,k){M.isVector4?Nt.set(M.x,M.y,M.z,M.w):Nt.set(M,D,$,k),xt.scissor(Z.copy(Nt).multiplyScalar(_n()).round())},this.getScissorTest=function(){return Ht},this.setScissorTest=function(M){xt.setScissorTest(Ht=M)},this.setOpaqueSort=function(M){Mt=M},this.setTransparentSort=function(M){Wt=M},this.getClearColor=function(M){return M.copy(P.getClearColor())},this.setClearColor=function(){P.setClearColor(...arguments)},this.getClearAlpha=function(){return P.getClearAlpha()},this.setClearAlpha=function(){P.setClearAlpha(...arguments)},this.clear=function(M=!0,D=!0,$=!0){let k=0;if(M){let G=!1;if(K!==null){let gt=K.texture.format;G=p.has(gt)}if(G){let gt=K.texture.type,St=m.has(gt),pt=P.getClearColor(),bt=P.getClearAlpha(),At=pt.r,Ft=pt.g,$t=pt.b;St?(y[0]=At,y[1]=Ft,y[2]=$t,y[3]=bt,O.clearBufferuiv(O.COLOR,0,y)):(S[0]=At,S[1]=Ft,S[2]=$t,S[3]=bt,O.clearBufferiv(O.COLOR,0,S))}else k|=O.COLOR_BUFFER_BIT}D&&(k|=O.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),$&&(k|=O.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),k!==0&&O.clear(k)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(M){M.setRenderer(this),I=M},this.dispose=function(){e.removeEventListener("webglcontextlost",Pt,!1),e.removeEventListener("webglcontextrestored",kt,!1),e.removeEventListener("webglcontextcreationerror",vt,!1),P.dispose(),mt.dispose(),j.dispose(),Ot.dispose(),Lt.dispose(),T.dispose(),at.dispose(),V.dispose(),ut.dispose(),Tt.dispose(),nt.dispose(),lt.dispose(),lt.removeEventListener("sessionstart",Xf),lt.removeEventListener("sessionend",$f),Qi.stop()};function Pt(M){M.preventDefault(),go("WebGLRenderer: Context Lost."),L=!0}function kt(){go("WebGLRenderer: Context Restored."),L=!1;let M=be.autoReset,D=ft.enabled,$=ft.autoUpdate,k=ft.needsUpdate,G=ft.type;Vt(),be.autoReset=M,ft.enabled=D,ft.autoUpdate=$,ft.needsUpdate=k,ft.type=G}function vt(M){Dt("WebGLRenderer: A WebGL context could not be created. Reason: ",M.statusMessage)}function ie(M){let D=M.target;D.removeEventListener("dispose",ie),Ae(D)}function Ae(M){Ti(M),Lt.remove(M)}function Ti(M){let D=Lt.get(M).programs;D!==void 0&&(D.forEach(function($){nt.releaseProgram($)}),M.isShaderMaterial&&nt.releaseShaderCache(M))}this.renderBufferDirect=function(M,D,$,k,G,gt){D===null&&(D=mn);let St=G.isMesh&&G.matrixWorld.determinantAffine()<0,pt=t_(M,D,$,k,G);xt.setMaterial(k,St);let bt=$.index,At=1;if(k.wireframe===!0){if(bt=V.getWireframeAttribute($),bt===void 0)return;At=2}let Ft=$.drawRange,$t=$.attributes.position,wt=Ft.start*At,qt=(Ft.start+Ft.count)*At;gt!==null&&(wt=Math.max(wt,gt.start*At),qt=Math.min(qt,(gt.start+gt.count)*At)),bt!==null?(wt=Math.max(wt,0),qt=Math.min(qt,bt.count)):$t!=null&&(wt=Math.max(wt,0),qt=Math.min(qt,$t.count));let xe=qt-wt;if(xe<0||xe===1/0)return;ut.setup(G,k,pt,$,bt);let ce,ae=J;if(bt!==null&&(ce=b.get(bt),ae=dt,ae.setIndex(ce)),G.isMesh)k.wireframe===!0?(xt.setLineWidth(k.wireframeLinewidth*_n()),ae.setMode(O.LINES)):ae.setMode(O.TRIANGLES);else if(G.isLine){let Be=k.linewidth;Be===void 0&&(Be=1),xt.setLineWidth(Be*_n()),G.isLineSegments?ae.setMode(O.LINES):G.isLineLoop?ae.setMode(O.LINE_LOOP):ae.setMode(O.LINE_STRIP)}else G.isPoints?ae.setMode(O.POINTS):G.isSprite&&ae.setMode(O.TRIANGLES);if(G.isBatchedMesh)if(fe.get("WEBGL_multi_draw"))ae.renderMultiDraw(G._multiDrawStarts,G._multiDrawCounts,G._multiDrawCount);else{let Be=G._multiDrawStarts,Et=G._multiDrawCounts,Ye=G._multiDrawCount,Qt=bt?b.get(bt).bytesPerElement:1,ts=Lt.get(k).currentProgram.getUniforms();for(let ke=0;ke<Ye;ke++)ts.setValue(O,"_gl_DrawID",ke),ae.render(Be[ke]/Qt,Et[ke])}else if(G.isInstancedMesh)ae.renderInstances(wt,xe,G.count);else if($.isInstancedBufferGeometry){let Be=$._maxInstanceCount!==void 0?$._maxInstanceCount:1/0,Et=Math.min($.instanceCount,Be);ae.renderInstances(wt,xe,Et)}else ae.render(wt,xe)};function Wf(M,D,$,k){I!==null&&M.isNodeMaterial&&I.setObject(k,M),jt===!0&&Q.setState(M,$,!1),M.transparent===!0&&M.side===Sn&&M.forceSinglePass===!1?(M.side=De,M.needsUpdate=!0,Br(M,D,k),M.side=Zi,M.needsUpdate=!0,Br(M,D,k),M.side=Sn):Br(M,D,k)}this.compile=function(M,D,$=null){$===null&&($=M),I!==null&&I.renderStart(M,D,$),E=j.get($),E.init(D),w.push(E),$.traverseVisible(function(G){G.isLight&&G.layers.test(D.layers)&&(E.pushLight(G),G.castShadow&&E.pushShadow(G))}),M!==$&&M.traverseVisible(function(G){G.isLight&&G.layers.test(D.layers)&&(E.pushLight(G),G.castShadow&&E.pushShadow(G))}),E.setupLights(),I!==null&&I.updateLights(E.state.lightsArray),ve=this.localClippingEnabled,jt=Q.init(this.clippingPlanes,ve),jt===!0&&Q.setGlobalState(this.clippingPlanes,D),I!==null&&ft.render(E.state.shadowsArray,$,D);let k=new Set;return M.traverse(function(G){if(!(G.isMesh||G.isPoints||G.isLine||G.isSprite))return;let gt=G.material;if(gt)if(Array.isArray(gt))for(let St=0;St<gt.length;St++){let pt=gt[St];Wf(pt,$,D,G),k.add(pt)}else Wf(gt,$,D,G),k.add(gt)}),E=w.pop(),I!==null&&I.renderEnd(),k},this.compileAsync=function(M,D,$=null){let k=this.compile(M,D,$);return new Promise(G=>{function gt(){if(k.forEach(function(St){let bt=Lt.get(St).currentProgram;(bt===void 0||bt.isReady())&&k.delete(St)}),k.size===0){G(M);return}setTimeout(gt,10)}fe.get("KHR_parallel_shader_compile")!==null?gt():setTimeout(gt,10)})};let ih=null;function j0(M){ih&&ih(M)}function Xf(){Qi.stop()}function $f(){Qi.start()}let Qi=new m0;Qi.setAnimationLoop(j0),typeof self<"u"&&Qi.setContext(self),this.setAnimationLoop=function(M){ih=M,lt.setAnimationLoop(M),M===null?Qi.stop():Qi.start()},lt.addEventListener("sessionstart",Xf),lt.addEventListener("sessionend",$f),this.render=function(M,D){if(D!==void 0&&D.isCamera!==!0){Dt("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(L===!0)return;I!==null&&I.renderStart(M,D);let $=lt.enabled===!0&&lt.isPresenting===!0,k=U!==null&&(K===null||$)&&U.begin(C,K);if(M.matrixWorldAutoUpdate===!0&&M.updateMatrixWorld(),D.parent===null&&D.matrixWorldAutoUpdate===!0&&D.updateMatrixWorld(),lt.enabled===!0&&lt.isPresenting===!0&&(U===null||U.isCompositing()===!1)&&(lt.cameraAutoUpdate===!0&&lt.updateCamera(D),D=lt.getCamera()),M.isScene===!0&&M.onBeforeRender(C,M,D,K),E=j.get(M,w.length),E.init(D),E.state.textureUnits=Ot.getTextureUnits(),w.push(E),me.multiplyMatrices(D.projectionMatrix,D.matrixWorldInverse),D.isArrayCamera?le.setFromArrayCamera(D):Ct.setFromProjectionMatrix(me,bn,D.reversedDepth),ve=this.localClippingEnabled,jt=Q.init(this.clippingPlanes,ve),A=mt.get(M,x.length),A.init(),x.push(A),this.info.render.frame++,lt.enabled===!0&&lt.isPresenting===!0){let St=C.xr.getDepthSensingMesh();St!==null&&sh(St,D,-1/0,C.sortObjects)}sh(M,D,0,C.sortObjects),A.finish(),I!==null&&I.updateLights(E.state.lightsArray),C.sortObjects===!0&&A.sort(Mt,Wt),gn=lt.enabled===!1||lt.isPresenting===!1||lt.hasDepthSensing()===!1,gn&&P.addToRenderList(A,M),this.info.autoReset===!0&&this.info.reset(),jt===!0&&Q.beginShadows();let G=E.state.shadowsArray;if(ft.render(G,M,D),jt===!0&&Q.endShadows(),(k&&U.hasRenderPass())===!1){let St=A.opaque,pt=A.transmissive;if(E.setupLights(),D.isArrayCamera){let bt=D.cameras;if(pt.length>0)for(let At=0,Ft=bt.length;At<Ft;At++){let $t=bt[At];Yf(St,pt,M,$t)}gn&&P.render(M);for(let At=0,Ft=bt.length;At<Ft;At++){let $t=bt[At];qf(A,M,$t,$t.viewport)}}else pt.length>0&&Yf(St,pt,M,D),gn&&P.render(M),qf(A,M,D)}K!==null&&H===0&&(Ot.updateMultisampleRenderTarget(K),Ot.updateRenderTargetMipmap(K)),k&&U.end(C),M.isScene===!0&&M.onAfterRender(C,M,D),ut.resetDefaultState(),X=-1,Y=null,w.pop(),w.length>0?(E=w[w.length-1],Ot.setTextureUnits(E.state.textureUnits),jt===!0&&Q.setGlobalState(C.clippingPlanes,E.state.camera)):E=null,x.pop(),x.length>0?A=x[x.length-1]:A=null,I!==null&&I.renderEnd()};function sh(M,D,$,k){if(M.visible===!1)return;if(M.layers.test(D.layers)){if(M.isGroup)$=M.renderOrder;else if(M.isLOD)M.autoUpdate===!0&&M.update(D);else if(M.isLight)E.pushLight(M),M.castShadow&&E.pushShadow(M);else if(M.isSprite){let St=D.isArrayCamera?le:Ct;if(!M.frustumCulled||M.intersectsFrustum(St)){k&&Ee.setFromMatrixPosition(M.matrixWorld).applyMatrix4(me);let pt=at.update(M),bt=M.material;bt.visible&&A.push(M,pt,bt,$,Ee.z,null,D)}}else if(M.isMesh||M.isLine||M.isPoints){let St=D.isArrayCamera?le:Ct;if(!M.frustumCulled||M.intersectsFrustum(St)){let pt=at.update(M),bt=M.material;if(k&&(M.boundingSphere!==void 0?(M.boundingSphere===null&&M.computeBoundingSphere(),Ee.copy(M.boundingSphere.center)):(pt.boundingSphere===null&&pt.computeBoundingSphere(),Ee.copy(pt.boundingSphere.center)),Ee.applyMatrix4(M.matrixWorld).applyMatrix4(me)),Array.isArray(bt)){let At=pt.groups;for(let Ft=0,$t=At.length;Ft<$t;Ft++){let wt=At[Ft],qt=bt[wt.materialIndex];qt&&qt.visible&&A.push(M,pt,qt,$,Ee.z,wt,D)}}else bt.visible&&A.push(M,pt,bt,$,Ee.z,null,D)}}}let gt=M.children;for(let St=0,pt=gt.length;St<pt;St++)sh(gt[St],D,$,k)}function qf(M,D,$,k){let{opaque:G,transmissive:gt,transparent:St}=M;E.setupLightsView($),jt===!0&&Q.setGlobalState(C.clippingPlanes,$),k&&xt.viewport(rt.copy(k)),G.length>0&&ea(G,D,$),gt.length>0&&ea(gt,D,$),St.length>0&&ea(St,D,$),xt.buffers.depth.setTest(!0),xt.buffers.depth.setMask(!0),xt.buffers.color.setMask(!0),xt.setPolygonOffset(!1)}function Yf(M,D,$,k){if(($.isScene===!0?$.overrideMaterial:null)!==null)return;if(E.state.transmissionRenderTarget[k.id]===void 0){let wt=fe.has("EXT_color_buffer_half_float")||fe.has("EXT_color_buffer_float");E.state.transmissionRenderTarget[k.id]=new fn(1,1,{generateMipmaps:!0,type:wt?kn:ln,minFilter:wi,samples:Math.max(4,de.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:Yt.workingColorSpace})}let gt=E.state.transmissionRenderTarget[k.id],St=k.viewport||rt;gt.setSize(St.z*C.transmissionResolutionScale,St.w*C.transmissionResolutionScale);let pt=C.getRenderTarget(),bt=C.getActiveCubeFace(),At=C.getActiveMipmapLevel();C.setRenderTarget(gt),C.getClearColor(z),it=C.getClearAlpha(),it<1&&C.setClearColor(16777215,.5),C.clear(),gn&&P.render($);let Ft=C.toneMapping;C.toneMapping=Jn;let $t=k.viewport;if(k.viewport!==void 0&&(k.viewport=void 0),E.setupLightsView(k),jt===!0&&Q.setGlobalState(C.clippingPlanes,k),ea(M,$,k),Ot.updateMultisampleRenderTarget(gt),Ot.updateRenderTargetMipmap(gt),fe.has("WEBGL_multisampled_render_to_texture")===!1){let wt=!1;for(let qt=0,xe=D.length;qt<xe;qt++){let ce=D[qt],{object:ae,geometry:Be,material:Et,group:Ye}=ce;if(Et.side===Sn&&ae.layers.test(k.layers)){let Qt=Et.side;Et.side=De,Et.needsUpdate=!0,Zf(ae,$,k,Be,Et,Ye),Et.side=Qt,Et.needsUpdate=!0,wt=!0}}wt===!0&&(Ot.updateMultisampleRenderTarget(gt),Ot.updateRenderTargetMipmap(gt))}C.setRenderTarget(pt,bt,At),C.setClearColor(z,it),$t!==void 0&&(k.viewport=$t),C.toneMapping=Ft}function ea(M,D,$){let k=D.isScene===!0?D.overrideMaterial:null;for(let G=0,gt=M.length;G<gt;G++){let St=M[G],{object:pt,geometry:bt,group:At}=St,Ft=St.material;Ft.allowOverride===!0&&k!==null&&(Ft=k),pt.layers.test($.layers)&&Zf(pt,D,$,bt,Ft,At)}}function Zf(M,D,$,k,G,gt){I!==null&&G.isNodeMaterial&&I.setObject(M,G),M.onBeforeRender(C,D,$,k,G,gt),M.modelViewMatrix.multiplyMatrices($.matrixWorldInverse,M.matrixWorld),M.normalMatrix.getNormalMatrix(M.modelViewMatrix),G.onBeforeRender(C,D,$,k,M,gt),G.transparent===!0&&G.side===Sn&&G.forceSinglePass===!1?(G.side=De,G.needsUpdate=!0,C.renderBufferDirect($,D,k,G,M,gt),G.side=Zi,G.needsUpdate=!0,C.renderBufferDirect($,D,k,G,M,gt),G.side=Sn):C.renderBufferDirect($,D,k,G,M,gt),M.onAfterRender(C,D,$,k,G,gt)}function Jf(M){let D=0;for(let $ of M)$.texture!==null&&D++;return D}function Br(M,D,$){D.isScene!==!0&&(D=mn);let k=Lt.get(M),G=E.state.lights,gt=E.state.shadowsArray,St=G.state.version,pt=nt.getParameters(M,G.state,gt,D,$,E.state.lightProbeGridArray),bt=nt.getProgramCacheKey(pt),At=k.programs;k.environment=M.isMeshStandardMaterial||M.isMeshLambertMaterial||M.isMeshPhongMaterial?D.environment:null,k.fog=D.fog;let Ft=M.isMeshStandardMaterial||M.isMeshLambertMaterial&&!M.envMap||M.isMeshPhongMaterial&&!M.envMap;k.envMap=T.get(M.envMap||k.environment,Ft),k.envMapRotation=k.environment!==null&&M.envMap===null?D.environmentRotation:M.envMapRotation,At===void 0&&(M.addEventListener("dispose",ie),At=new Map,k.programs=At,k.programVariants=new Map);let $t=At.get(bt);if($t!==void 0){if(k.currentProgram===$t&&k.lightsStateVersion===St)return jf(M,pt),$t}else pt.uniforms=nt.getUniforms(M),I!==null&&M.isNodeMaterial&&I.build(M,$,pt),M.onBeforeCompile(pt,C),$t=nt.acquireProgram(pt,bt),At.set(bt,$t),k.uniforms=pt.uniforms;let wt=k.uniforms;return(!M.isShaderMaterial&&!M.isRawShaderMaterial||M.clipping===!0)&&(wt.clippingPlanes=Q.uniform),jf(M,pt),k.needsLights=n_(M),k.lightsStateVersion=St,k.needsLights&&(wt.ambientLightColor.value=G.state.ambient,wt.lightProbe.value=G.state.probe,wt.sunLights.value=G.state.sun,wt.sunLightShadows.value=G.state.sunShadow,wt.directionalLights.value=G.state.directional,wt.directionalLightShadows.value=G.state.directionalShadow,wt.spotLights.value=G.state.spot,wt.spotLightShadows.value=G.state.spotShadow,wt.rectAreaLights.value=G.state.rectArea,wt.ltc_1.value=G.state.rectAreaLTC1,wt.ltc_2.value=G.state.rectAreaLTC2,wt.pointLights.value=G.state.point,wt.pointLightShadows.value=G.state.pointShadow,wt.hemisphereLights.value=G.state.hemi,wt.sunShadowMatrix.value=G.state.sunShadowMatrix,wt.sunShadowCascade.value=G.state.sunShadowCascade,wt.directionalShadowMatrix.value=G.state.directionalShadowMatrix,wt.spotLightMatrix.value=G.state.spotLightMatrix,wt.spotLightMap.value=G.state.spotLightMap,wt.pointShadowMatrix.value=G.state.pointShadowMatrix),k.numLightProbeGrids=Jf(E.state.lightProbeGridArray),k.currentProgram=$t,k.uniformsList=null,$t}function Q0(M,D,$,k,G){let gt=Lt.get(M),St=gt.currentProgram.id+","+k+","+G,pt=gt.programVariants.get(St);return pt===void 0?(pt=Br(M,D,$),gt.programVariants.set(St,pt)):(gt.currentProgram=pt,gt.uniformsList=null,gt.outputColorSpace=k,gt.toneMapping=G),pt}function Kf(M){if(M.uniformsList===null){let D=M.currentProgram.getUniforms();M.uniformsList=Ir.seqWithValue(D.seq,M.uniforms)}return M.uniformsList}function jf(M,D){let $=Lt.get(M);$.outputColorSpace=D.outputColorSpace,$.batching=D.batching,$.batchingColor=D.batchingColor,$.instancing=D.instancing,$.instancingColor=D.instancingColor,$.instancingMorph=D.instancingMorph,$.skinning=D.skinning,$.morphTargets=D.morphTargets,$.morphNormals=D.morphNormals,$.morphColors=D.morphColors,$.morphTargetsCount=D.morphTargetsCount,$.numClippingPlanes=D.numClippingPlanes,$.numIntersection=D.numClipIntersection,$.vertexAlphas=D.vertexAlphas,$.vertexTangents=D.vertexTangents,$.toneMapping=D.toneMapping}function t_(M,D,$,k,G){D.isScene!==!0&&(D=mn),Ot.resetTextureUnits();let gt=D.fog,St=k.isMeshStandardMaterial||k.isMeshLambertMaterial||k.isMeshPhongMaterial?D.environment:null,pt=K===null?C.outputColorSpace:K.isXRRenderTarget===!0?K.texture.colorSpace:Yt.workingColorSpace,bt=k.isMeshStandardMaterial||k.isMeshLambertMaterial&&!k.envMap||k.isMeshPhongMaterial&&!k.envMap,At=T.get(k.envMap||St,bt),Ft=k.vertexColors===!0&&!!$.attributes.color&&$.attributes.color.itemSize===4,$t=!!$.attributes.tangent&&(!!k.normalMap||k.anisotropy>0),wt=!!$.morphAttributes.position,qt=!!$.morphAttributes.normal,xe=!!$.morphAttributes.color,ce=Jn;k.toneMapped&&(K===null||K.isXRRenderTarget===!0)&&(ce=C.toneMapping);let ae=$.morphAttributes.position||$.morphAttributes.normal||$.morphAttributes.color,Be=ae!==void 0?ae.length:0,Et=Lt.get(k),Ye=E.state.lights;if(jt===!0&&(ve===!0||M!==Y)){let ge=M===Y&&k.id===X;Q.setState(k,M,ge)}let Qt=!1,ts=!1;k.version===Et.__version?Et.needsLights&&Et.lightsStateVersion!==Ye.state.version||G.isBatchedMesh&&Et.batching===!1||!G.isBatchedMesh&&Et.batching===!0||G.isBatchedMesh&&Et.batchingColor===!0&&G._colorsTexture===null||G.isBatchedMesh&&Et.batchingColor===!1&&G._colorsTexture!==null||G.isInstancedMesh&&Et.instancing===!1||!G.isInstancedMesh&&Et.instancing===!0||G.isSkinnedMesh&&Et.skinning===!1||!G.isSkinnedMesh&&Et.skinning===!0||G.isInstancedMesh&&Et.instancingColor===!0&&G.instanceColor===null||G.isInstancedMesh&&Et.instancingColor===!1&&G.instanceColor!==null||G.isInstancedMesh&&Et.instancingMorph===!0&&G.morphTexture===null||G.isInstancedMesh&&Et.instancingMorph===!1&&G.morphTexture!==null||Et.envMap!==At||k.fog===!0&&Et.fog!==gt||Et.numClippingPlanes!==void 0&&(Et.numClippingPlanes!==Q.numPlanes||Et.numIntersection!==Q.numIntersection)||Et.vertexAlphas!==Ft||Et.vertexTangents!==$t||Et.morphTargets!==wt||Et.morphNormals!==qt||Et.morphColors!==xe||Et.morphTargetsCount!==Be||Et.numLightProbeGrids!==Jf(E.state.lightProbeGridArray)?Qt=!0:(Et.outputColorSpace!==pt||Et.toneMapping!==ce)&&(ts=!0):(Qt=!0,Et.__version=k.version);let ke=Et.currentProgram;(Qt===!0||ts===!0)&&(ke=ts===!0?Q0(k,D,G,pt,ce):Br(k,D,G),I&&k.isNodeMaterial&&I.onUpdateProgram(k,ke,Et));let na=!1,Ci=!1,es=!1,Kt=ke.getUniforms(),Le=Et.uniforms;if(xt.useProgram(ke.program)&&(na=!0,Ci=!0,es=!0),k.id!==X&&(X=k.id,Ci=!0),na||Y!==M){xt.buffers.depth.getReversed()&&M.reversedDepth!==!0&&(M._reversedDepth=!0,M.updateProjectionMatrix()),Kt.setValue(O,"projectionMatrix",M.projectionMatrix),Kt.setValue(O,"viewMatrix",M.matrixWorldInverse);let Te=Kt.map.cameraPosition;Te!==void 0&&Te.setValue(O,Vn.setFromMatrixPosition(M.matrixWorld)),de.logarithmicDepthBuffer&&Kt.setValue(O,"logDepthBufFC",2/(Math.log(M.far+1)/Math.LN2)),(k.isMeshPhongMaterial||k.isMeshToonMaterial||k.isMeshLambertMaterial||k.isMeshBasicMaterial||k.isMeshStandardMaterial||k.isShaderMaterial)&&Kt.setValue(O,"isOrthographic",M.isOrthographicCamera===!0),Y!==M&&(Y=M,Ci=!0,es=!0)}if(Et.needsLights&&(Ye.state.sunShadowMap.length>0&&Kt.setValue(O,"sunShadowMap",Ye.state.sunShadowMap,Ot),Ye.state.directionalShadowMap.length>0&&Kt.setValue(O,"directionalShadowMap",Ye.state.directionalShadowMap,Ot),Ye.state.spotShadowMap.length>0&&Kt.setValue(O,"spotShadowMap",Ye.state.spotShadowMap,Ot),Ye.state.pointShadowMap.length>0&&Kt.setValue(O,"pointShadowMap",Ye.state.pointShadowMap,Ot)),G.isSkinnedMesh){Kt.setOptional(O,G,"bindMatrix"),Kt.setOptional(O,G,"bindMatrixInverse");let ge=G.skeleton;ge&&(ge.boneTexture===null&&ge.computeBoneTexture(),Kt.setValue(O,"boneTexture",ge.boneTexture,Ot))}G.isBatchedMesh&&(Kt.setOptional(O,G,"batchingTexture"),Kt.setValue(O,"batchingTexture",G._matricesTexture,Ot),Kt.setOptional(O,G,"batchingIdTexture"),Kt.setValue(O,"batchingIdTexture",G._indirectTexture,Ot),Kt.setOptional(O,G,"batchingColorTexture"),G._colorsTexture!==null&&Kt.setValue(O,"batchingColorTexture",G._colorsTexture,Ot));let wn=$.morphAttributes;if((wn.position!==void 0||wn.normal!==void 0||wn.color!==void 0)&&tt.update(G,$,ke),(Ci||Et.receiveShadow!==G.receiveShadow)&&(Et.receiveShadow=G.receiveShadow,Kt.setValue(O,"receiveShadow",G.receiveShadow)),(k.isMeshStandardMaterial||k.isMeshLambertMaterial||k.isMeshPhongMaterial)&&k.envMap===null&&D.environment!==null&&(Le.envMapIntensity.value=D.environmentIntensity),Le.dfgLUT!==void 0&&(Le.dfgLUT.value=nE()),Ci){if(Kt.setValue(O,"toneMappingExposure",C.toneMappingExposure),Et.needsLights&&e_(Le,es),gt&&k.fog===!0&&ht.refreshFogUniforms(Le,gt),ht.refreshMaterialUniforms(Le,k,st,et,E.state.transmissionRenderTarget[M.id]),Et.needsLights&&Et.numLightProbeGrids>0){let ge=v,Te=0;for(let ii of E.state.lightProbeGridArray)ii.texture!==null&&(ge.textures[Te]=ii.texture,ge.min[Te]=ii.boundingBox.min,ge.max[Te]=ii.boundingBox.max,ge.resolution[Te]=ii.resolution,Te++);for(let ii in ge)ge[ii].length=Te;Le.probesSH.value=ge.textures,Le.probesMin.value=ge.min,Le.probesMax.value=ge.max,Le.probesResolution.value=ge.resolution}Ir.upload(O,Kf(Et),Le,Ot)}if(k.isShaderMaterial&&k.uniformsNeedUpdate===!0&&(Ir.upload(O,Kf(Et),Le,Ot),k.uniformsNeedUpdate=!1),k.isSpriteMaterial&&Kt.setValue(O,"center",G.center),Kt.setValue(O,"modelViewMatrix",G.modelViewMatrix),Kt.setValue(O,"normalMatrix",G.normalMatrix),Kt.setValue(O,"modelMatrix",G.matrixWorld),k.uniformsGroups!==void 0){let ge=k.uniformsGroups;for(let Te=0,ii=ge.length;Te<ii;Te++){let td=ge[Te];Tt.update(td,ke),Tt.bind(td,ke)}}return ke}function e_(M,D){M.ambientLightColor.needsUpdate=D,M.lightProbe.needsUpdate=D,M.sunLights.needsUpdate=D,M.sunLightShadows.needsUpdate=D,M.directionalLights.needsUpdate=D,M.directionalLightShadows.needsUpdate=D,M.pointLights.needsUpdate=D,M.pointLightShadows.needsUpdate=D,M.spotLights.needsUpdate=D,M.spotLightShadows.needsUpdate=D,M.rectAreaLights.needsUpdate=D,M.hemisphereLights.needsUpdate=D}function n_(M){return M.isMeshLambertMaterial||M.isMeshToonMaterial||M.isMeshPhongMaterial||M.isMeshStandardMaterial||M.isShadowMaterial||M.isShaderMaterial&&M.lights===!0}this.getActiveCubeFace=function(){return q},this.getActiveMipmapLevel=function(){return H},this.getRenderTarget=function(){return K},this.setRenderTargetTextures=function(M,D,$){let k=Lt.get(M);k.__autoAllocateDepthBuffer=M.resolveDepthBuffer===!1,k.__autoAllocateDepthBuffer===!1&&(k.__useRenderToTexture=!1),Lt.get(M.texture).__webglTexture=D,Lt.get(M.depthTexture).__webglTexture=k.__autoAllocateDepthBuffer?void 0:$,k.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(M,D){let $=Lt.get(M);$.__webglFramebuffer=D,$.__useDefaultFramebuffer=D===void 0},this.setRenderTarget=function(M,D=0,$=0){K=M,q=D,H=$;let k=null,G=!1,gt=!1;if(M){let pt=Lt.get(M);if(pt.__useDefaultFramebuffer!==void 0){xt.bindFramebuffer(O.FRAMEBUFFER,pt.__webglFramebuffer),rt.copy(M.viewport),Z.copy(M.scissor),ot=M.scissorTest,xt.viewport(rt),xt.scissor(Z),xt.setScissorTest(ot),X=-1;return}else if(pt.__webglFramebuffer===void 0)Ot.setupRenderTarget(M);else if(pt.__hasExternalTextures)Ot.rebindTextures(M,Lt.get(M.texture).__webglTexture,Lt.get(M.depthTexture).__webglTexture);else if(M.depthBuffer){let Ft=M.depthTexture;if(pt.__boundDepthTexture!==Ft){if(Ft!==null&&Lt.has(Ft)&&(M.width!==Ft.image.width||M.height!==Ft.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Ot.setupDepthRenderbuffer(M)}}let bt=M.texture;(bt.isData3DTexture||bt.isDataArrayTexture||bt.isCompressedArrayTexture)&&(gt=!0);let At=Lt.get(M).__webglFramebuffer;M.isWebGLCubeRenderTarget?(Array.isArray(At[D])?k=At[D][$]:k=At[D],G=!0):M.samples>0&&Ot.useMultisampledRTT(M)===!1?k=Lt.get(M).__webglMultisampledFramebuffer:Array.isArray(At)?k=At[$]:k=At,rt.copy(M.viewport),Z.copy(M.scissor),ot=M.scissorTest}else rt.copy(yt).multiplyScalar(st).floor(),Z.copy(Nt).multiplyScalar(st).floor(),ot=Ht;if($!==0&&(k=B),xt.bindFramebuffer(O.FRAMEBUFFER,k)&&xt.drawBuffers(M,k),xt.viewport(rt),xt.scissor(Z),xt.setScissorTest(ot),G){let pt=Lt.get(M.texture);O.framebufferTexture2D(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_CUBE_MAP_POSITIVE_X+D,pt.__webglTexture,$)}else if(gt){let pt=D;for(let bt=0;bt<M.textures.length;bt++){let At=Lt.get(M.textures[bt]);O.framebufferTextureLayer(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0+bt,At.__webglTexture,$,pt)}}else if(M!==null&&$!==0){let pt=Lt.get(M.texture);O.framebufferTexture2D(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,pt.__webglTexture,$)}X=-1};function Qf(M){let D=Lt.get(M);return(D.__readFormat!==M.format||D.__readType!==M.type)&&(D.__readFormat=M.format,D.__readType=M.type,D.__formatReadable=de.textureFormatReadable(M.format),D.__typeReadable=de.textureTypeReadable(M.type)),D}this.readRenderTargetPixels=function(M,D,$,k,G,gt,St,pt=0){if(!(M&&M.isWebGLRenderTarget)){Dt("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let bt=Lt.get(M).__webglFramebuffer;if(M.isWebGLCubeRenderTarget&&St!==void 0&&(bt=bt[St],Array.isArray(bt)&&(bt=bt[0])),bt){xt.bindFramebuffer(O.FRAMEBUFFER,bt);try{let At=M.textures[pt],Ft=At.format,$t=At.type;M.textures.length>1&&O.readBuffer(O.COLOR_ATTACHMENT0+pt);let wt=Qf(At);if(wt.__formatReadable===!1){Dt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(wt.__typeReadable===!1){Dt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}D>=0&&D<=M.width-k&&$>=0&&$<=M.height-G&&O.readPixels(D,$,k,G,ct.convert(Ft),ct.convert($t),gt)}finally{let At=K!==null?Lt.get(K).__webglFramebuffer:null;xt.bindFramebuffer(O.FRAMEBUFFER,At)}}},this.readRenderTargetPixelsAsync=async function(M,D,$,k,G,gt,St,pt=0){if(!(M&&M.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let bt=Lt.get(M).__webglFramebuffer;if(M.isWebGLCubeRenderTarget&&St!==void 0&&(bt=bt[St],Array.isArray(bt)&&(bt=bt[0])),bt)if(D>=0&&D<=M.width-k&&$>=0&&$<=M.height-G){xt.bindFramebuffer(O.FRAMEBUFFER,bt);let At=M.textures[pt],Ft=At.format,$t=At.type;M.textures.length>1&&O.readBuffer(O.COLOR_ATTACHMENT0+pt);let wt=Qf(At);if(wt.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(wt.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let qt=O.createBuffer();O.bindBuffer(O.PIXEL_PACK_BUFFER,qt),O.bufferData(O.PIXEL_PACK_BUFFER,gt.byteLength,O.STREAM_READ),O.readPixels(D,$,k,G,ct.convert(Ft),ct.convert($t),0),O.bindBuffer(O.PIXEL_PACK_BUFFER,null);let xe=K!==null?Lt.get(K).__webglFramebuffer:null;xt.bindFramebuffer(O.FRAMEBUFFER,xe);let ce=O.fenceSync(O.SYNC_GPU_COMMANDS_COMPLETE,0);return O.flush(),await Hg(O,ce,4),O.bindBuffer(O.PIXEL_PACK_BUFFER,qt),O.getBufferSubData(O.PIXEL_PACK_BUFFER,0,gt),O.bindBuffer(O.PIXEL_PACK_BUFFER,null),O.deleteBuffer(qt),O.deleteSync(ce),gt}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(M,D=null,$=0){let k=Math.pow(2,-$),G=Math.floor(M.image.width*k),gt=Math.floor(M.image.height*k),St=D!==null?D.x:0,pt=D!==null?D.y:0;Ot.setTexture2D(M,0),O.copyTexSubImage2D(O.TEXTURE_2D,$,0,0,St,pt,G,gt),xt.unbindTexture()},this.copyTextureToTexture=function(M,D,$=null,k=null,G=0,gt=0){let St,pt,bt,At,Ft,$t,wt,qt,xe,ce=M.isCompressedTexture?M.mipmaps[gt]:M.image;if($!==null)St=$.max.x-$.min.x,pt=$.max.y-$.min.y,bt=$.isBox3?$.max.z-$.min.z:1,At=$.min.x,Ft=$.min.y,$t=$.isBox3?$.min.z:0;else{let Kt=Math.pow(2,-G);St=Math.floor(ce.width*Kt),pt=Math.floor(ce.height*Kt),M.isDataArrayTexture?bt=ce.depth:M.isData3DTexture?bt=Math.floor(ce.depth*Kt):bt=1,At=0,Ft=0,$t=0}k!==null?(wt=k.x,qt=k.y,xe=k.z):(wt=0,qt=0,xe=0);let ae=ct.convert(D.format),Be=ct.convert(D.type),Et;D.isData3DTexture?(Ot.setTexture3D(D,0),Et=O.TEXTURE_3D):D.isDataArrayTexture||D.isCompressedArrayTexture?(Ot.setTexture2DArray(D,0),Et=O.TEXTURE_2D_ARRAY):(Ot.setTexture2D(D,0),Et=O.TEXTURE_2D),xt.activeTexture(O.TEXTURE0),xt.pixelStorei(O.UNPACK_FLIP_Y_WEBGL,D.flipY),xt.pixelStorei(O.UNPACK_PREMULTIPLY_ALPHA_WEBGL,D.premultiplyAlpha),xt.pixelStorei(O.UNPACK_ALIGNMENT,D.unpackAlignment);let Ye=xt.getParameter(O.UNPACK_ROW_LENGTH),Qt=xt.getParameter(O.UNPACK_IMAGE_HEIGHT),ts=xt.getParameter(O.UNPACK_SKIP_PIXELS),ke=xt.getParameter(O.UNPACK_SKIP_ROWS),na=xt.getParameter(O.UNPACK_SKIP_IMAGES);xt.pixelStorei(O.UNPACK_ROW_LENGTH,ce.width),xt.pixelStorei(O.UNPACK_IMAGE_HEIGHT,ce.height),xt.pixelStorei(O.UNPACK_SKIP_PIXELS,At),xt.pixelStorei(O.UNPACK_SKIP_ROWS,Ft),xt.pixelStorei(O.UNPACK_SKIP_IMAGES,$t);let Ci=M.isDataArrayTexture||M.isData3DTexture,es=D.isDataArrayTexture||D.isData3DTexture;if(M.isDepthTexture){let Kt=Lt.get(M),Le=Lt.get(D),wn=Lt.get(Kt.__renderTarget),ge=Lt.get(Le.__renderTarget);xt.bindFramebuffer(O.READ_FRAMEBUFFER,wn.__webglFramebuffer),xt.bindFramebuffer(O.DRAW_FRAMEBUFFER,ge.__webglFramebuffer);for(let Te=0;Te<bt;Te++)Ci&&(O.framebufferTextureLayer(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,Lt.get(M).__webglTexture,G,$t+Te),O.framebufferTextureLayer(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,Lt.get(D).__webglTexture,gt,xe+Te)),O.blitFramebuffer(At,Ft,At+St,Ft+pt,wt,qt,wt+St,qt+pt,O.DEPTH_BUFFER_BIT,O.NEAREST);xt.bindFramebuffer(O.READ_FRAMEBUFFER,null),xt.bindFramebuffer(O.DRAW_FRAMEBUFFER,null)}else if(G!==0||M.isRenderTargetTexture||Lt.has(M)){let Kt=Lt.get(M),Le=Lt.get(D);xt.bindFramebuffer(O.READ_FRAMEBUFFER,R),xt.bindFramebuffer(O.DRAW_FRAMEBUFFER,W);for(let wn=0;wn<bt;wn++)Ci?O.framebufferTextureLayer(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,Kt.__webglTexture,G,$t+wn):O.framebufferTexture2D(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,Kt.__webglTexture,G),es?O.framebufferTextureLayer(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,Le.__webglTexture,gt,xe+wn):O.framebufferTexture2D(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,Le.__webglTexture,gt),G!==0?O.blitFramebuffer(At,Ft,At+St,Ft+pt,wt,qt,wt+St,qt+pt,O.COLOR_BUFFER_BIT,O.NEAREST):es?O.copyTexSubImage3D(Et,gt,wt,qt,xe+wn,At,Ft,St,pt):O.copyTexSubImage2D(Et,gt,wt,qt,At,Ft,St,pt);xt.bindFramebuffer(O.READ_FRAMEBUFFER,null),xt.bindFramebuffer(O.DRAW_FRAMEBUFFER,null)}else es?M.isDataTexture||M.isData3DTexture?O.texSubImage3D(Et,gt,wt,qt,xe,St,pt,bt,ae,Be,ce.data):D.isCompressedArrayTexture?O.compressedTexSubImage3D(Et,gt,wt,qt,xe,St,pt,bt,ae,ce.data):O.texSubImage3D(Et,gt,wt,qt,xe,St,pt,bt,ae,Be,ce):M.isDataTexture?O.texSubImage2D(O.TEXTURE_2D,gt,wt,qt,St,pt,ae,Be,ce.data):M.isCompressedTexture?O.compressedTexSubImage2D(O.TEXTURE_2D,gt,wt,qt,ce.width,ce.height,ae,ce.data):O.texSubImage2D(O.TEXTURE_2D,gt,wt,qt,St,pt,ae,Be,ce);xt.pixelStorei(O.UNPACK_ROW_LENGTH,Ye),xt.pixelStorei(O.UNPACK_IMAGE_HEIGHT,Qt),xt.pixelStorei(O.UNPACK_SKIP_PIXELS,ts),xt.pixelStorei(O.UNPACK_SKIP_ROWS,ke),xt.pixelStorei(O.UNPACK_SKIP_IMAGES,na),gt===0&&D.generateMipmaps===!0&&D.mipmapsAutoUpdate===!0&&O.generateMipmap(Et),xt.unbindTexture()},this.initRenderTarget=function(M){Lt.get(M).__webglFramebuffer===void 0&&Ot.setupRenderTarget(M)},this.initTexture=function(M){M.isCubeTexture?Ot.setTextureCube(M,0):M.isData3DTexture?Ot.setTexture3D(M,0):M.isDataArrayTexture||M.isCompressedArrayTexture?Ot.setTexture2DArray(M,0):Ot.setTexture2D(M,0),xt.unbindTexture()},this.resetState=function(){q=0,H=0,K=null,xt.reset(),ut.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return bn}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;let e=this.getContext();e.drawingBufferColorSpace=Yt._getDrawingBufferColorSpace(t),e.unpackColorSpace=Yt._getUnpackColorSpace()}};var iE={white:"#f4f1e8",yellow:"#f0c43c",red:"#c63a32",blue:"#3569b0",green:"#2f8559",black:"#33353a",pink:"#dd8fa6",brown:"#8a5a3a"},A0=["#f4f1e8","#c63a32","#f0c43c","#3569b0","#2f8559","#d9822b","#7d4fa0","#8a5a3a","#dd8fa6","#4aa3a2"],Nr=(n,t)=>iE[n.name??""]??A0[t%A0.length];function sE(n,t){let e=document.createElement("canvas");e.width=256,e.height=128;let i=e.getContext("2d");i.fillStyle=n,i.fillRect(0,0,256,128),i.fillStyle=t;let s=(o,a)=>{i.beginPath(),i.ellipse(o,a,12/Math.max(Math.sin(a/128*Math.PI),.05),12,0,0,7),i.fill()};for(let o of[32,96,160,224])s(o,64);i.fillRect(0,0,256,12),i.fillRect(0,116,256,12);let r=new wr(e);return r.colorSpace=Je,r}var Uf=null;function rE(){if(Uf)return Uf;let n=document.createElement("canvas");n.width=n.height=128;let t=n.getContext("2d"),e=t.createRadialGradient(64,64,20,64,64,64);return e.addColorStop(0,"rgba(0,0,0,1)"),e.addColorStop(.55,"rgba(0,0,0,0.75)"),e.addColorStop(1,"rgba(0,0,0,0)"),t.fillStyle=e,t.fillRect(0,0,128,128),Uf=new wr(n)}var oE=new ws(1,40,20).rotateX(Math.PI/2),aE=new wo(1,32),lE=new Ss(1.16,1.34,48),Yc=class{constructor(t,e,{ghost:i=!1,halo:s=null,floor:r,dark:o}){this.radius=1,this.group=new Xe;let a=sE(t,e),c=new Es({map:a,transparent:i,opacity:i?.55:1,depthWrite:!0});if(this.ball=new _e(oE,c),this.group.add(this.ball),this.shadow=null,r){let l=new On({map:rE(),transparent:!0,opacity:(o?.75:.42)*(i?.5:1),depthWrite:!1});this.shadow=new _e(aE,l),this.group.add(this.shadow)}this.halo=null,s&&r&&(this.halo=new _e(lE,new On({color:new zt(s),transparent:!0,opacity:i?.8:1,depthWrite:!1})),this.group.add(this.halo))}resize(t){this.radius=t,this.ball.scale.setScalar(t),this.halo?.scale.setScalar(t)}place(t,e,i){if(this.group.visible=i>.02*this.radius,!this.group.visible)return;i<1/0&&(this.ball.material.opacity=.6*Math.min(1,i/this.radius)),this.ball.position.set(t[0],t[1],t[2]),this.ball.quaternion.set(e[1],e[2],e[3],e[0]);let s=Math.max(0,t[2]-this.radius);this.shadow&&(this.shadow.position.set(t[0]-.5*s-.06*this.radius,t[1]+1.4*s+.14*this.radius,.004*this.radius),this.shadow.scale.setScalar(this.radius*(1.12+Math.min(1,.25*s/this.radius)))),this.halo&&this.halo.position.set(t[0],t[1],.008*this.radius)}};function Zc(n){let t=!1;return()=>{t||(t=!0,requestAnimationFrame(()=>{t=!1,n()}))}}var R0=[{name:"free",label:"3-D"},{name:"above",label:"Above"},{name:"side",label:"Side"},{name:"along",label:"Along the wall"}],P0=1e4,Dr=n=>.16*jn(n.box)/Math.max(1,Math.hypot(...n.scene.balls[n.ball].velocity)/2||1),jn=({low:n,high:t})=>Math.max(t[0]-n[0],t[1]-n[1],.001),Ur=({low:n,high:t})=>[(n[0]+t[0])/2,(n[1]+t[1])/2,(n[2]+t[2])/2];function Qo(n,t){let e=1.2*jn(t),i=Ur(t),s=(r,o)=>{let a=Math.hypot(o[0],o[1]);if(a<1e-6)return[];let[c,l]=[o[0]/a,o[1]/a],h=((r[0]-i[0])*o[0]+(r[1]-i[1])*o[1]+r[2]*o[2])/a,[u,f]=[i[0]+h*c,i[1]+h*l];return[[u-e*-l,f-e*c],[u+e*-l,f+e*c]]};switch(n.shape){case"plane":return[s(n.point,Ge(n.normal))];case"strip":{let r=Ge(n.normal),o=n.point.map((a,c)=>a+n.width*r[c]);return[s(n.point,r),s(o,r)]}case"wedge":{let r=[n.from_angle,n.to_angle].map(c=>c*Math.PI/180),[o,a]=n.apex;return[r.map(c=>[o+e*Math.cos(c),a+e*Math.sin(c)])].map(([c,l])=>[c,[o,a],l])}case"segment":return[[n.start,n.end]];case"polygon":return[n.closed?[...n.points,n.points[0]]:n.points];case"table":{let[r,o]=n.center;return[T0(r-n.length/2,o-n.width/2,r+n.length/2,o+n.width/2)]}case"box":{let[r,o]=Of(n);return[T0(r[0],r[1],o[0],o[1])]}case"sphere":return[jo(n.center,n.radius,0,360)];case"cylinder":return[jo(n.point,n.radius,0,360)];case"arc":return[jo(n.center,n.radius,n.from_angle,n.to_angle)];case"stadium":{let[r,o]=[Math.cos(n.angle*Math.PI/180),Math.sin(n.angle*Math.PI/180)],a=n.length/2,c=[1,-1].map(h=>[n.center[0]+h*a*r,n.center[1]+h*a*o]),l=[...jo(c[0],n.radius,n.angle-90,n.angle+90),...jo(c[1],n.radius,n.angle+90,n.angle+270)];return[[...l,l[0]]]}default:return[]}}var T0=(n,t,e,i)=>[[n,t],[e,t],[e,i],[n,i],[n,t]];function jo(n,t,e,i){let s=Math.max(8,Math.ceil(Math.abs(i-e)/4));return Array.from({length:s+1},(r,o)=>{let a=(e+(i-e)*o/s)*Math.PI/180;return[n[0]+t*Math.cos(a),n[1]+t*Math.sin(a)]})}function Of(n){let t=n.corner??n.center.map((e,i)=>e-n.size[i]/2);return[t,t.map((e,i)=>e+n.size[i])]}var cE=["table","box","segment","polygon","sphere","arc","stadium"],C0=n=>cE.includes(n.shape)||n.shape==="cylinder"&&Math.abs(Ge(n.axis)[2])>.99&&n.radius<P0;function ta(n,t,e,i){let s=[1/0,1/0,n.floor?0:1/0],r=[-1/0,-1/0,-1/0],o=(f,d=0)=>{for(let g=0;g<f.length;g++)Math.abs(f[g])>P0||(s[g]=Math.min(s[g],f[g]-d),r[g]=Math.max(r[g],f[g]+d))},a={low:[0,0,0],high:[0,0,0]},c=n.walls.some(f=>C0(f)&&f.shape!=="segment");for(let f of n.walls)if(C0(f))for(let d of Qo(f,a))for(let g of d)o(g);n.balls.forEach(f=>o(f.position,f.radius));let l=f=>f.map((d,g)=>Math.max(s[g]-h,Math.min(r[g]+h,d))),h=1/0;for(let f of new Set([e,...t.keys()])){let d=t.get(f);d?.balls.forEach(({pieces:g},_)=>{let p=n.balls[_].radius,[m,y]=n.balls[_].position;for(let{points:S}of ks(g,i,p))for(let v of S)o(c?[m,y,v[2]]:h<1/0?l(v):v,p)}),d&&h===1/0&&(h=.25*Math.max(r[0]-s[0],r[1]-s[1]))}let u=10*Math.max(...n.balls.map(f=>f.radius));for(let f of[0,1]){let d=(u-(r[f]-s[f]))/2;d>0&&(s[f]-=d,r[f]+=d)}return{low:s,high:r}}function Jc(n,t,e){let i=Math.max(...t.balls.map(c=>c.radius)),s=as(n.low??"-inf"),r=as(n.height??"inf"),o=t.floor?0:Math.min(e.low[2],-i),a=Math.max(o+1.7*i,Math.min(e.high[2],o+8*i));return[Math.max(s,o),Math.min(r,a)]}var hE={rolling:[],sliding:[7,4],flight:[1.5,3.5]},I0=24,L0=1.8;function N0(n,t){let e=document.createElement("canvas");e.tabIndex=0,e.setAttribute("role","img"),n.prepend(e);let i=null,s=null,r=0,o=Zc(_),a=null,c=[0,0],l=1,h=[];function u(p){let[m,y]=[n.clientWidth,n.clientHeight],{low:S,high:v}=p.box,A=Math.min(.3*y,150),E=Math.min((m-40)/(v[0]-S[0]),(y-A-50)/(v[1]-S[1])),[x,w]=[(S[0]+v[0])/2,(S[1]+v[1])/2],U=Math.max(v[2]-S[2],1e-6),C=Math.min(E,(A-50)/U);return{width:m,height:y,k:E,up:C,strip:A,above:(L,I)=>[m/2+E*(L-x),(y-A)/2-E*(I-w)],side:(L,I)=>[m/2+E*(L-x),y-34-C*(I-S[2])],metres:(L,I)=>[x+(L-m/2)/E,w-(I-(y-A)/2)/E]}}function f(){if(!i)return[0,0];let{position:p,velocity:m,radius:y}=i.scene.balls[i.ball],S=Math.hypot(m[0],m[1]),v=S>0?[m[0]/S,m[1]/S]:[1,0],A=L0*y+S*l;return[p[0]+v[0]*A,p[1]+v[1]*A]}e.addEventListener("pointerdown",p=>{if(!i||t===null||p.button!==0)return;let m=u(i),y=i.scene.balls[i.ball],S=x=>Math.hypot(x[0]-p.offsetX,x[1]-p.offsetY),v=f();if(S(m.above(v[0],v[1]))<I0)a="velocity";else if(S(m.above(y.position[0],y.position[1]))<Math.max(I0,m.k*y.radius))a="ball";else return;let A=m.metres(p.offsetX,p.offsetY),E=a==="ball"?y.position:v;c=[E[0]-A[0],E[1]-A[1]],e.setPointerCapture(p.pointerId),t.start()}),e.addEventListener("pointermove",p=>{if(!a||!i||t===null)return;let[m,y]=u(i).metres(p.offsetX,p.offsetY).map((x,w)=>x+c[w]);if(a==="ball"){t.ball(m,y);return}let{position:S,radius:v}=i.scene.balls[i.ball],A=Math.hypot(m-S[0],y-S[1]),E=Math.max(0,A-L0*v)/l;t.velocity(E*(m-S[0])/(A||1),E*(y-S[1])/(A||1))});let d=()=>{a&&(a=null,i&&(l=Dr(i)),t?.end(),o())};e.addEventListener("pointerup",d),e.addEventListener("pointercancel",d);function g(p,m){i=p,s=m,a||(l=Dr(p)),h=[];for(let[y,S]of p.runs)S.balls.forEach(({pieces:v},A)=>{(y===p.followed||A===p.ball)&&h.push({law:y,ball:A,turns:new Li(v)})});o()}function _(){if(!i||!s)return;let p=u(i),m=Math.min(devicePixelRatio,2);(e.width!==Math.round(p.width*m)||e.height!==Math.round(p.height*m))&&(e.width=Math.round(p.width*m),e.height=Math.round(p.height*m),e.style.width=`${p.width}px`,e.style.height=`${p.height}px`);let y=e.getContext("2d");y.setTransform(m,0,0,m,0,0),y.fillStyle=s.background,y.fillRect(0,0,p.width,p.height),y.strokeStyle=s.edge,y.lineWidth=2;for(let x of i.scene.walls)for(let w of Qo(x,i.box))y.beginPath(),w.forEach(([U,C])=>y.lineTo(...ji(p.above(U,C)))),y.stroke();y.fillStyle=s.floor,y.fillRect(0,p.height-p.strip,p.width,p.strip),y.fillStyle=s.soft,y.font="12px system-ui, sans-serif",y.fillText("from above",12,20),y.fillText(p.up<p.k*.99?"from the side (heights reduced)":"from the side",12,p.height-p.strip+18),i.scene.floor&&(y.strokeStyle=s.edge,y.beginPath(),y.moveTo(...ji(p.side(i.box.low[0]-1e3,0))),y.lineTo(...ji(p.side(i.box.high[0]+1e3,0))),y.stroke());for(let{law:x,ball:w,turns:U}of h){y.strokeStyle=w===i.ball?i.colours.get(x)??s.ink:Nr(i.scene.balls[w],w),y.lineWidth=x===i.followed&&w===i.ball?2.4:1.4;for(let{style:C,points:L}of ks(U.pieces,i.span,i.scene.balls[w].radius)){y.setLineDash(hE[C]);for(let I of[B=>p.above(B[0],B[1]),B=>p.side(B[0],B[2])])y.beginPath(),L.forEach(B=>y.lineTo(...ji(I(B)))),y.stroke()}y.setLineDash([])}let S=f(),v=i.scene.balls[i.ball].position;t&&(y.strokeStyle=y.fillStyle=s.ink,y.lineWidth=2,y.beginPath(),y.moveTo(...ji(p.above(v[0],v[1]))),y.lineTo(...ji(p.above(S[0],S[1]))),y.stroke(),y.beginPath(),y.arc(...ji(p.above(S[0],S[1])),5,0,7),y.fill()),[e.dataset.ball,e.dataset.arrow]=[v,S].map(x=>p.above(x[0],x[1]).map(Math.round).join());let A=i.runs.get(i.followed),E=A?Wn(A.balls[i.ball].pieces,r).x:null;for(let{law:x,ball:w,turns:U}of[...h].reverse()){let{x:C}=Wn(U.pieces,r),L=x===i.followed;if(!L&&E&&Math.hypot(C[0]-E[0],C[1]-E[1],C[2]-E[2])<.02*i.scene.balls[w].radius)continue;let I=L?Nr(i.scene.balls[w],w):i.colours.get(x)??s.ink,B=Math.max(3,p.k*i.scene.balls[w].radius),[R,W,q,H]=U.at(r),K=[1-2*(q*q+H*H),2*(W*q+R*H),2*(W*H-R*q)];for(let[X,Y,rt,Z]of[[p.above(C[0],C[1]),K[0],-K[1],K[2]],[p.side(C[0],C[2]),K[0],-K[2],-K[1]]])y.globalAlpha=L?1:.55,y.fillStyle=I,y.strokeStyle=s.edge,y.lineWidth=1,y.beginPath(),y.arc(...ji(X),B,0,7),y.fill(),y.stroke(),Z>0&&(y.fillStyle=s.ink,y.beginPath(),y.arc(X[0]+B*Y,X[1]+B*rt,Math.max(1.2,.2*B),0,7),y.fill()),y.globalAlpha=1}}return{update:g,trace(p){i&&(i={...i,span:p})},draw(p){r=p,o()},look:()=>o(),resize:()=>o(),picture(){return _(),new Promise((p,m)=>e.toBlob(y=>y?p(y):m(new Error("The browser gave no picture.")),"image/png"))}}}var ji=n=>[n[0],n[1]];var D0={type:"change"},Bf={type:"start"},O0={type:"end"},Kc=new zi,U0=new Ke,uE=Math.cos(70*$o.DEG2RAD),we=new N,cn=2*Math.PI,te={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},Ff=1e-6,jc=class extends Fo{constructor(t,e=null){super(t,e),this.state=te.NONE,this.target=new N,this.cursor=new N,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:qi.ROTATE,MIDDLE:qi.DOLLY,RIGHT:qi.PAN},this.touches={ONE:Yi.ROTATE,TWO:Yi.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new N,this._lastQuaternion=new Ne,this._lastTargetPosition=new N,this._quat=new Ne().setFromUnitVectors(t.up,new N(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new Ar,this._sphericalDelta=new Ar,this._scale=1,this._panOffset=new N,this._rotateStart=new Rt,this._rotateEnd=new Rt,this._rotateDelta=new Rt,this._panStart=new Rt,this._panEnd=new Rt,this._panDelta=new Rt,this._dollyStart=new Rt,this._dollyEnd=new Rt,this._dollyDelta=new Rt,this._dollyDirection=new N,this._mouse=new Rt,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=dE.bind(this),this._onPointerDown=fE.bind(this),this._onPointerUp=pE.bind(this),this._onContextMenu=bE.bind(this),this._onMouseWheel=_E.bind(this),this._onKeyDown=xE.bind(this),this._onTouchStart=yE.bind(this),this._onTouchMove=vE.bind(this),this._onMouseDown=mE.bind(this),this._onMouseMove=gE.bind(this),this._interceptControlDown=ME.bind(this),this._interceptControlUp=SE.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(t){this._cursorStyle=t,t==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(t){super.connect(t),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=te.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(t){t.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=t}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(D0),this.update(),this.state=te.NONE}pan(t,e){this._pan(t,e),this.update()}dollyIn(t){this._dollyIn(t),this.update()}dollyOut(t){this._dollyOut(t),this.update()}rotateLeft(t){this._rotateLeft(t),this.update()}rotateUp(t){this._rotateUp(t),this.update()}update(t=null){let e=this.object.position;we.copy(e).sub(this.target),we.applyQuaternion(this._quat),this._spherical.setFromVector3(we),this.autoRotate&&this.state===te.NONE&&this._rotateLeft(this._getAutoRotationAngle(t)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let i=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(i)&&isFinite(s)&&(i<-Math.PI?i+=cn:i>Math.PI&&(i-=cn),s<-Math.PI?s+=cn:s>Math.PI&&(s-=cn),i<=s?this._spherical.theta=Math.max(i,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(i+s)/2?Math.max(i,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(we.setFromSpherical(this._spherical),we.applyQuaternion(this._quatInverse),e.copy(this.target).add(we),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){let a=we.length();o=this._clampDistance(a*this._scale);let c=a-o;this.object.position.addScaledVector(this._dollyDirection,c),this.object.updateMatrixWorld(),r=!!c}else if(this.object.isOrthographicCamera){let a=new N(this._mouse.x,this._mouse.y,0);a.unproject(this.object);let c=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=c!==this.object.zoom;let l=new N(this._mouse.x,this._mouse.y,0);l.unproject(this.object),this.object.position.sub(l).add(a),this.object.updateMatrixWorld(),o=we.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(Kc.origin.copy(this.object.position),Kc.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(Kc.direction))<uE?this.object.lookAt(this.target):(U0.setFromNormalAndCoplanarPoint(this.object.up,this.target),Kc.intersectPlane(U0,this.target))))}else if(this.object.isOrthographicCamera){let o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>Ff||8*(1-this._lastQuaternion.dot(this.object.quaternion))>Ff||this._lastTargetPosition.distanceToSquared(this.target)>Ff?(this.dispatchEvent(D0),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(t){return t!==null?cn/60*this.autoRotateSpeed*t:cn/60/60*this.autoRotateSpeed}_getZoomScale(t){let e=Math.abs(t*.01);return Math.pow(.95,this.zoomSpeed*e)}_rotateLeft(t){this._sphericalDelta.theta-=t}_rotateUp(t){this._sphericalDelta.phi-=t}_panLeft(t,e){we.setFromMatrixColumn(e,0),we.multiplyScalar(-t),this._panOffset.add(we)}_panUp(t,e){this.screenSpacePanning===!0?we.setFromMatrixColumn(e,1):(we.setFromMatrixColumn(e,0),we.crossVectors(this.object.up,we)),we.multiplyScalar(t),this._panOffset.add(we)}_pan(t,e){let i=this.domElement;if(this.object.isPerspectiveCamera){let s=this.object.position;we.copy(s).sub(this.target);let r=we.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*t*r/i.clientHeight,this.object.matrix),this._panUp(2*e*r/i.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(t*(this.object.right-this.object.left)/this.object.zoom/i.clientWidth,this.object.matrix),this._panUp(e*(this.object.top-this.object.bottom)/this.object.zoom/i.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(t,e){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let i=this.domElement.getBoundingClientRect(),s=t-i.left,r=e-i.top,o=i.width,a=i.height;this._mouse.x=s/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(t){return Math.max(this.minDistance,Math.min(this.maxDistance,t))}_handleMouseDownRotate(t){this._rotateStart.set(t.clientX,t.clientY)}_handleMouseDownDolly(t){this._updateZoomParameters(t.clientX,t.clientY),this._dollyStart.set(t.clientX,t.clientY)}_handleMouseDownPan(t){this._panStart.set(t.clientX,t.clientY)}_handleMouseMoveRotate(t){this._rotateEnd.set(t.clientX,t.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(cn*this._rotateDelta.x/e.clientHeight),this._rotateUp(cn*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(t){this._dollyEnd.set(t.clientX,t.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(t){this._panEnd.set(t.clientX,t.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(t){this._updateZoomParameters(t.clientX,t.clientY),t.deltaY<0?this._dollyIn(this._getZoomScale(t.deltaY)):t.deltaY>0&&this._dollyOut(this._getZoomScale(t.deltaY)),this.update()}_handleKeyDown(t){let e=!1;switch(t.code){case this.keys.UP:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(cn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),e=!0;break;case this.keys.BOTTOM:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(-cn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),e=!0;break;case this.keys.LEFT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(cn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),e=!0;break;case this.keys.RIGHT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(-cn*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),e=!0;break}e&&(t.preventDefault(),this.update())}_handleTouchStartRotate(t){if(this._pointers.length===1)this._rotateStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),i=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._rotateStart.set(i,s)}}_handleTouchStartPan(t){if(this._pointers.length===1)this._panStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),i=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panStart.set(i,s)}}_handleTouchStartDolly(t){let e=this._getSecondPointerPosition(t),i=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(i*i+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enablePan&&this._handleTouchStartPan(t)}_handleTouchStartDollyRotate(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enableRotate&&this._handleTouchStartRotate(t)}_handleTouchMoveRotate(t){if(this._pointers.length==1)this._rotateEnd.set(t.pageX,t.pageY);else{let i=this._getSecondPointerPosition(t),s=.5*(t.pageX+i.x),r=.5*(t.pageY+i.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(cn*this._rotateDelta.x/e.clientHeight),this._rotateUp(cn*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(t){if(this._pointers.length===1)this._panEnd.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),i=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panEnd.set(i,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(t){let e=this._getSecondPointerPosition(t),i=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(i*i+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let o=(t.pageX+e.x)*.5,a=(t.pageY+e.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enablePan&&this._handleTouchMovePan(t)}_handleTouchMoveDollyRotate(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enableRotate&&this._handleTouchMoveRotate(t)}_addPointer(t){this._pointers.push(t.pointerId)}_removePointer(t){delete this._pointerPositions[t.pointerId];for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId){this._pointers.splice(e,1);return}}_isTrackingPointer(t){for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId)return!0;return!1}_trackPointer(t){let e=this._pointerPositions[t.pointerId];e===void 0&&(e=new Rt,this._pointerPositions[t.pointerId]=e),e.set(t.pageX,t.pageY)}_getSecondPointerPosition(t){let e=t.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[e]}_customWheelEvent(t){let e=t.deltaMode,i={clientX:t.clientX,clientY:t.clientY,deltaY:t.deltaY};switch(e){case 1:i.deltaY*=16;break;case 2:i.deltaY*=100;break}return t.ctrlKey&&!this._controlActive&&(i.deltaY*=10),i}};function fE(n){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(n.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(n)&&(this._addPointer(n),n.pointerType==="touch"?this._onTouchStart(n):this._onMouseDown(n),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function dE(n){this.enabled!==!1&&(n.pointerType==="touch"?this._onTouchMove(n):this._onMouseMove(n))}function pE(n){switch(this._removePointer(n),this._pointers.length){case 0:this.domElement.releasePointerCapture(n.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(O0),this.state=te.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let t=this._pointers[0],e=this._pointerPositions[t];this._onTouchStart({pointerId:t,pageX:e.x,pageY:e.y});break}}function mE(n){let t;switch(n.button){case 0:t=this.mouseButtons.LEFT;break;case 1:t=this.mouseButtons.MIDDLE;break;case 2:t=this.mouseButtons.RIGHT;break;default:t=-1}switch(t){case qi.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(n),this.state=te.DOLLY;break;case qi.ROTATE:if(n.ctrlKey||n.metaKey||n.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(n),this.state=te.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(n),this.state=te.ROTATE}break;case qi.PAN:if(n.ctrlKey||n.metaKey||n.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(n),this.state=te.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(n),this.state=te.PAN}break;default:this.state=te.NONE}this.state!==te.NONE&&this.dispatchEvent(Bf)}function gE(n){switch(this.state){case te.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(n);break;case te.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(n);break;case te.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(n);break}}function _E(n){this.enabled===!1||this.enableZoom===!1||this.state!==te.NONE||(n.preventDefault(),this.dispatchEvent(Bf),this._handleMouseWheel(this._customWheelEvent(n)),this.dispatchEvent(O0))}function xE(n){this.enabled!==!1&&this._handleKeyDown(n)}function yE(n){switch(this._trackPointer(n),this._pointers.length){case 1:switch(this.touches.ONE){case Yi.ROTATE:if(this.enableRotate===!1){this.state=te.NONE;break}this._handleTouchStartRotate(n),this.state=te.TOUCH_ROTATE;break;case Yi.PAN:if(this.enablePan===!1){this.state=te.NONE;break}this._handleTouchStartPan(n),this.state=te.TOUCH_PAN;break;default:this.state=te.NONE}break;case 2:switch(this.touches.TWO){case Yi.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(n),this.state=te.TOUCH_DOLLY_PAN;break;case Yi.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(n),this.state=te.TOUCH_DOLLY_ROTATE;break;default:this.state=te.NONE}break;default:this.state=te.NONE}this.state!==te.NONE&&this.dispatchEvent(Bf)}function vE(n){switch(this._trackPointer(n),this.state){case te.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(n),this.update();break;case te.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(n),this.update();break;case te.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(n),this.update();break;case te.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(n),this.update();break;default:this.state=te.NONE}}function bE(n){this.enabled!==!1&&n.preventDefault()}function ME(n){n.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function SE(n){n.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}_t.line={worldUnits:{value:1},linewidth:{value:1},resolution:{value:new Rt},dashOffset:{value:0},dashScale:{value:1},dashSize:{value:1},gapSize:{value:1}};en.line={uniforms:qo.merge([_t.common,_t.fog,_t.line]),vertexShader:`
		#include <common>
		#include <color_pars_vertex>
		#include <fog_pars_vertex>
		#include <logdepthbuf_pars_vertex>
		#include <clipping_planes_pars_vertex>

		uniform float linewidth;
		uniform vec2 resolution;

		attribute vec3 instanceStart;
		attribute vec3 instanceEnd;

		attribute vec3 instanceColorStart;
		attribute vec3 instanceColorEnd;

		#ifdef WORLD_UNITS

			varying vec4 worldPos;
			varying vec3 worldStart;
			varying vec3 worldEnd;

			#ifdef USE_DASH

				varying vec2 vUv;

			#endif

		#else

			varying vec2 vUv;

		#endif

		#ifdef USE_DASH

			uniform float dashScale;
			attribute float instanceDistanceStart;
			attribute float instanceDistanceEnd;
			varying float vLineDistance;

		#endif

		float trimSegmentAlpha( const in vec4 start, const in vec4 end ) {

			// compute the interpolation factor needed to trim the segment so it terminates
			// between the camera plane and the near plane

			// conservative estimate of the near plane
			float a = projectionMatrix[ 2 ][ 2 ]; // 3nd entry in 3th column
			float b = projectionMatrix[ 3 ][ 2 ]; // 3nd entry in 4th column

			// we need different nearEstimate formula for reversed and default depth buffer
			// a is positive with a reversed depth buffer so it can be used for controlling the code flow
			float nearEstimate = ( a > 0.0 ) ? ( - b / ( a + 1.0 ) ) : ( - 0.5 * b / a );

			return ( nearEstimate - start.z ) / ( end.z - start.z );

		}

		void main() {

			#ifdef USE_COLOR

				vColor.xyz = ( position.y < 0.5 ) ? instanceColorStart : instanceColorEnd;

			#endif

			float aspect = resolution.x / resolution.y;

			// camera space
			vec4 start = modelViewMatrix * vec4( instanceStart, 1.0 );
			vec4 end = modelViewMatrix * vec4( instanceEnd, 1.0 );

			#ifdef USE_DASH

				float lineDistanceStart = dashScale * instanceDistanceStart;
				float lineDistanceEnd = dashScale * instanceDistanceEnd;

			#endif

			#ifdef WORLD_UNITS

				worldStart = start.xyz;
				worldEnd = end.xyz;

			#else

				vUv = uv;

			#endif

			// special case for perspective projection, and segments that terminate either in, or behind, the camera plane
			// clearly the gpu firmware has a way of addressing this issue when projecting into ndc space
			// but we need to perform ndc-space calculations in the shader, so we must address this issue directly
			// perhaps there is a more elegant solution -- WestLangley

			bool perspective = ( projectionMatrix[ 2 ][ 3 ] == - 1.0 ); // 4th entry in the 3rd column

			if ( perspective ) {

				if ( start.z < 0.0 && end.z >= 0.0 ) {

					float alpha = trimSegmentAlpha( start, end );
					end.xyz = mix( start.xyz, end.xyz, alpha );

					#ifdef USE_DASH

						lineDistanceEnd = mix( lineDistanceStart, lineDistanceEnd, alpha );

					#endif

				} else if ( end.z < 0.0 && start.z >= 0.0 ) {

					float alpha = trimSegmentAlpha( end, start );
					start.xyz = mix( end.xyz, start.xyz, alpha );

					#ifdef USE_DASH

						lineDistanceStart = mix( lineDistanceEnd, lineDistanceStart, alpha );

					#endif

				}

			}

			#ifdef USE_DASH

				vLineDistance = ( position.y < 0.5 ) ? lineDistanceStart : lineDistanceEnd;
				vUv = uv;

			#endif

			// clip space
			vec4 clipStart = projectionMatrix * start;
			vec4 clipEnd = projectionMatrix * end;

			// ndc space
			vec3 ndcStart = clipStart.xyz / clipStart.w;
			vec3 ndcEnd = clipEnd.xyz / clipEnd.w;

			// direction
			vec2 dir = ndcEnd.xy - ndcStart.xy;

			// account for clip-space aspect ratio
			dir.x *= aspect;
			dir = normalize( dir );

			#ifdef WORLD_UNITS

				vec3 worldDir = normalize( end.xyz - start.xyz );
				vec3 tmpFwd = perspective ? normalize( mix( start.xyz, end.xyz, 0.5 ) ) : vec3( 0.0, 0.0, - 1.0 );
				vec3 worldUp = normalize( cross( worldDir, tmpFwd ) );
				vec3 worldFwd = cross( worldDir, worldUp );
				worldPos = position.y < 0.5 ? start: end;

				// height offset
				float hw = linewidth * 0.5;
				worldPos.xyz += position.x < 0.0 ? hw * worldUp : - hw * worldUp;

				// don't extend the line if we're rendering dashes because we
				// won't be rendering the endcaps
				#ifndef USE_DASH

					// cap extension
					worldPos.xyz += position.y < 0.5 ? - hw * worldDir : hw * worldDir;

					// add width to the box
					worldPos.xyz += worldFwd * hw;

					// endcaps
					if ( position.y > 1.0 || position.y < 0.0 ) {

						worldPos.xyz -= worldFwd * 2.0 * hw;

					}

				#endif

				// project the worldpos
				vec4 clip = projectionMatrix * worldPos;

				// shift the depth of the projected points so the line
				// segments overlap neatly
				vec3 clipPose = ( position.y < 0.5 ) ? ndcStart : ndcEnd;

				// only shift the depth of vertices in front of the camera (#35137)
				if ( clip.w > 0.0 ) clip.z = clipPose.z * clip.w;

			#else

				vec2 offset = vec2( dir.y, - dir.x );
				// undo aspect ratio adjustment
				dir.x /= aspect;
				offset.x /= aspect;

				// sign flip
				if ( position.x < 0.0 ) offset *= - 1.0;

				// endcaps
				if ( position.y < 0.0 ) {

					offset += - dir;

				} else if ( position.y > 1.0 ) {

					offset += dir;

				}

				// adjust for linewidth
				offset *= linewidth;

				// adjust for clip-space to screen-space conversion // maybe resolution should be based on viewport ...
				offset /= resolution.y;

				// select end
				vec4 clip = ( position.y < 0.5 ) ? clipStart : clipEnd;

				// back to clip space
				offset *= clip.w;

				clip.xy += offset;

			#endif

			gl_Position = clip;

			vec4 mvPosition = ( position.y < 0.5 ) ? start : end; // this is an approximation

			#include <logdepthbuf_vertex>
			#include <clipping_planes_vertex>
			#include <fog_vertex>

		}
		`,fragmentShader:`
		uniform vec3 diffuse;
		uniform float opacity;
		uniform float linewidth;

		#ifdef USE_DASH

			uniform float dashOffset;
			uniform float dashSize;
			uniform float gapSize;

		#endif

		varying float vLineDistance;

		#ifdef WORLD_UNITS

			varying vec4 worldPos;
			varying vec3 worldStart;
			varying vec3 worldEnd;

			#ifdef USE_DASH

				varying vec2 vUv;

			#endif

		#else

			varying vec2 vUv;

		#endif

		#include <common>
		#include <color_pars_fragment>
		#include <fog_pars_fragment>
		#include <logdepthbuf_pars_fragment>
		#include <clipping_planes_pars_fragment>

		vec2 closestLineToLine(vec3 p1, vec3 p2, vec3 p3, vec3 p4) {

			float mua;
			float mub;

			vec3 p13 = p1 - p3;
			vec3 p43 = p4 - p3;

			vec3 p21 = p2 - p1;

			float d1343 = dot( p13, p43 );
			float d4321 = dot( p43, p21 );
			float d1321 = dot( p13, p21 );
			float d4343 = dot( p43, p43 );
			float d2121 = dot( p21, p21 );

			float denom = d2121 * d4343 - d4321 * d4321;

			float numer = d1343 * d4321 - d1321 * d4343;

			mua = numer / denom;
			mua = clamp( mua, 0.0, 1.0 );
			mub = ( d1343 + d4321 * ( mua ) ) / d4343;
			mub = clamp( mub, 0.0, 1.0 );

			return vec2( mua, mub );

		}

		void main() {

			float alpha = opacity;
			vec4 diffuseColor = vec4( diffuse, alpha );

			#include <clipping_planes_fragment>

			#ifdef USE_DASH

				if ( vUv.y < - 1.0 || vUv.y > 1.0 ) discard; // discard endcaps

				if ( mod( vLineDistance + dashOffset, dashSize + gapSize ) > dashSize ) discard; // todo - FIX

			#endif

			#ifdef WORLD_UNITS

				float len;

				if ( isOrthographic ) {

					// View rays are parallel to the z axis so the distance reduces to camera-space XY
					vec2 lineDir = worldEnd.xy - worldStart.xy;
					float t = clamp( dot( worldPos.xy - worldStart.xy, lineDir ) / dot( lineDir, lineDir ), 0.0, 1.0 );
					len = length( worldStart.xy + lineDir * t - worldPos.xy );

				} else {

					// Find the closest points on the view ray and the line segment
					vec3 rayEnd = normalize( worldPos.xyz ) * 1e5;
					vec3 lineDir = worldEnd - worldStart;
					vec2 params = closestLineToLine( worldStart, worldEnd, vec3( 0.0, 0.0, 0.0 ), rayEnd );

					vec3 p1 = worldStart + lineDir * params.x;
					vec3 p2 = rayEnd * params.y;
					vec3 delta = p1 - p2;
					len = length( delta );

				}

				float norm = len / linewidth;

				#ifndef USE_DASH

					#ifdef USE_ALPHA_TO_COVERAGE

						float dnorm = fwidth( norm );
						alpha = 1.0 - smoothstep( 0.5 - dnorm, 0.5 + dnorm, norm );

					#else

						if ( norm > 0.5 ) {

							discard;

						}

					#endif

				#endif

			#else

				#ifdef USE_ALPHA_TO_COVERAGE

					// artifacts appear on some hardware if a derivative is taken within a conditional
					float a = vUv.x;
					float b = ( vUv.y > 0.0 ) ? vUv.y - 1.0 : vUv.y + 1.0;
					float len2 = a * a + b * b;
					float dlen = fwidth( len2 );

					if ( abs( vUv.y ) > 1.0 ) {

						alpha = 1.0 - smoothstep( 1.0 - dlen, 1.0 + dlen, len2 );

					}

				#else

					if ( abs( vUv.y ) > 1.0 ) {

						float a = vUv.x;
						float b = ( vUv.y > 0.0 ) ? vUv.y - 1.0 : vUv.y + 1.0;
						float len2 = a * a + b * b;

						if ( len2 > 1.0 ) discard;

					}

				#endif

			#endif

			#include <logdepthbuf_fragment>
			#include <color_fragment>

			gl_FragColor = vec4( diffuseColor.rgb, alpha );

			#include <tonemapping_fragment>
			#include <colorspace_fragment>
			#include <fog_fragment>
			#include <premultiplied_alpha_fragment>

		}
		`};var Or=class extends Mn{constructor(t){super({type:"LineMaterial",uniforms:qo.clone(en.line.uniforms),vertexShader:en.line.vertexShader,fragmentShader:en.line.fragmentShader,clipping:!0}),this.isLineMaterial=!0,this.setValues(t)}get color(){return this.uniforms.diffuse.value}set color(t){this.uniforms.diffuse.value=t}get worldUnits(){return"WORLD_UNITS"in this.defines}set worldUnits(t){t===!0!==this.worldUnits&&(this.needsUpdate=!0),t===!0?this.defines.WORLD_UNITS="":delete this.defines.WORLD_UNITS}get linewidth(){return this.uniforms.linewidth.value}set linewidth(t){this.uniforms.linewidth&&(this.uniforms.linewidth.value=t)}get dashed(){return"USE_DASH"in this.defines}set dashed(t){t===!0!==this.dashed&&(this.needsUpdate=!0),t===!0?this.defines.USE_DASH="":delete this.defines.USE_DASH}get dashScale(){return this.uniforms.dashScale.value}set dashScale(t){this.uniforms.dashScale.value=t}get dashSize(){return this.uniforms.dashSize.value}set dashSize(t){this.uniforms.dashSize.value=t}get dashOffset(){return this.uniforms.dashOffset.value}set dashOffset(t){this.uniforms.dashOffset.value=t}get gapSize(){return this.uniforms.gapSize.value}set gapSize(t){this.uniforms.gapSize.value=t}get opacity(){return this.uniforms.opacity.value}set opacity(t){this.uniforms&&(this.uniforms.opacity.value=t)}get resolution(){return this.uniforms.resolution.value}set resolution(t){this.uniforms.resolution.value.copy(t)}get alphaToCoverage(){return"USE_ALPHA_TO_COVERAGE"in this.defines}set alphaToCoverage(t){this.defines&&(t===!0!==this.alphaToCoverage&&(this.needsUpdate=!0),t===!0?this.defines.USE_ALPHA_TO_COVERAGE="":delete this.defines.USE_ALPHA_TO_COVERAGE)}};var F0=new dn,Qc=new N,Is=class extends Do{constructor(){super(),this.isLineSegmentsGeometry=!0,this.type="LineSegmentsGeometry";let t=[-1,2,0,1,2,0,-1,1,0,1,1,0,-1,0,0,1,0,0,-1,-1,0,1,-1,0],e=[-1,2,1,2,-1,1,1,1,-1,-1,1,-1,-1,-2,1,-2],i=[0,2,1,2,3,1,2,4,3,4,5,3,4,6,5,6,7,5];this.setIndex(i),this.setAttribute("position",new Xt(t,3)),this.setAttribute("uv",new Xt(e,2))}applyMatrix4(t){let e=this.attributes.instanceStart,i=this.attributes.instanceEnd;return e!==void 0&&(e.applyMatrix4(t),i.applyMatrix4(t),e.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this}setPositions(t){let e;t instanceof Float32Array?e=t:Array.isArray(t)&&(e=new Float32Array(t));let i=new $i(e,6,1);return this.setAttribute("instanceStart",new Un(i,3,0)),this.setAttribute("instanceEnd",new Un(i,3,3)),this.instanceCount=this.attributes.instanceStart.count,this.computeBoundingBox(),this.computeBoundingSphere(),this}setColors(t){let e;t instanceof Float32Array?e=t:Array.isArray(t)&&(e=new Float32Array(t));let i=new $i(e,6,1);return this.setAttribute("instanceColorStart",new Un(i,3,0)),this.setAttribute("instanceColorEnd",new Un(i,3,3)),this}fromWireframeGeometry(t){return this.setPositions(t.attributes.position.array),this}fromEdgesGeometry(t){return this.setPositions(t.attributes.position.array),this}fromMesh(t){return this.fromWireframeGeometry(new To(t.geometry)),this}fromLineSegments(t){let e=t.geometry;return this.setPositions(e.attributes.position.array),this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new dn);let t=this.attributes.instanceStart,e=this.attributes.instanceEnd;t!==void 0&&e!==void 0&&(this.boundingBox.setFromBufferAttribute(t),F0.setFromBufferAttribute(e),this.boundingBox.union(F0))}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Dn),this.boundingBox===null&&this.computeBoundingBox();let t=this.attributes.instanceStart,e=this.attributes.instanceEnd;if(t!==void 0&&e!==void 0){let i=this.boundingSphere.center;this.boundingBox.getCenter(i);let s=0;for(let r=0,o=t.count;r<o;r++)Qc.fromBufferAttribute(t,r),s=Math.max(s,i.distanceToSquared(Qc)),Qc.fromBufferAttribute(e,r),s=Math.max(s,i.distanceToSquared(Qc));this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&console.error("THREE.LineSegmentsGeometry.computeBoundingSphere(): Computed radius is NaN. The instanced position data is likely to have NaN values.",this)}}toJSON(){}};var kf=new ne,B0=new N,k0=new N,Ue=new ne,Oe=new ne,Qn=new ne,zf=new N,Vf=new oe,Fe=new Oo,z0=new N,th=new dn,eh=new Dn,ti=new ne,ei,Ls;function V0(n,t,e){return ti.set(0,0,-t,1).applyMatrix4(n.projectionMatrix),ti.multiplyScalar(1/ti.w),ti.x=Ls/e.width,ti.y=Ls/e.height,ti.applyMatrix4(n.projectionMatrixInverse),ti.multiplyScalar(1/ti.w),Math.abs(Math.max(ti.x,ti.y))}function wE(n,t){let e=n.matrixWorld,i=n.geometry,s=i.attributes.instanceStart,r=i.attributes.instanceEnd,o=Math.min(i.instanceCount,s.count);for(let a=0,c=o;a<c;a++){Fe.start.fromBufferAttribute(s,a),Fe.end.fromBufferAttribute(r,a),Fe.applyMatrix4(e);let l=new N,h=new N;ei.distanceSqToSegment(Fe.start,Fe.end,h,l),h.distanceTo(l)<Ls*.5&&t.push({point:h,pointOnLine:l,distance:ei.origin.distanceTo(h),object:n,face:null,faceIndex:a,uv:null,uv1:null})}}function EE(n,t,e){let i=t.projectionMatrix,r=n.material.resolution,o=n.matrixWorld,a=n.geometry,c=a.attributes.instanceStart,l=a.attributes.instanceEnd,h=Math.min(a.instanceCount,c.count),u=-t.near;ei.at(1,Qn),Qn.w=1,Qn.applyMatrix4(t.matrixWorldInverse),Qn.applyMatrix4(i),Qn.multiplyScalar(1/Qn.w),Qn.x*=r.x/2,Qn.y*=r.y/2,Qn.z=0,zf.copy(Qn),Vf.multiplyMatrices(t.matrixWorldInverse,o);for(let f=0,d=h;f<d;f++){if(Ue.fromBufferAttribute(c,f),Oe.fromBufferAttribute(l,f),Ue.w=1,Oe.w=1,Ue.applyMatrix4(Vf),Oe.applyMatrix4(Vf),Ue.z>u&&Oe.z>u)continue;if(Ue.z>u){let S=Ue.z-Oe.z,v=(Ue.z-u)/S;Ue.lerp(Oe,v)}else if(Oe.z>u){let S=Oe.z-Ue.z,v=(Oe.z-u)/S;Oe.lerp(Ue,v)}Ue.applyMatrix4(i),Oe.applyMatrix4(i),Ue.multiplyScalar(1/Ue.w),Oe.multiplyScalar(1/Oe.w),Ue.x*=r.x/2,Ue.y*=r.y/2,Oe.x*=r.x/2,Oe.y*=r.y/2,Fe.start.copy(Ue),Fe.start.z=0,Fe.end.copy(Oe),Fe.end.z=0;let _=Fe.closestPointToPointParameter(zf,!0);Fe.at(_,z0);let p=$o.lerp(Ue.z,Oe.z,_),m=p>=-1&&p<=1,y=zf.distanceTo(z0)<Ls*.5;if(m&&y){Fe.start.fromBufferAttribute(c,f),Fe.end.fromBufferAttribute(l,f),Fe.start.applyMatrix4(o),Fe.end.applyMatrix4(o);let S=new N,v=new N;ei.distanceSqToSegment(Fe.start,Fe.end,v,S),e.push({point:v,pointOnLine:S,distance:ei.origin.distanceTo(v),object:n,face:null,faceIndex:f,uv:null,uv1:null})}}}var Fr=class extends _e{constructor(t=new Is,e=new Or({color:Math.random()*16777215})){super(t,e),this.isLineSegments2=!0,this.type="LineSegments2"}computeLineDistances(){let t=this.geometry,e=t.attributes.instanceStart,i=t.attributes.instanceEnd,s=new Float32Array(2*e.count);for(let o=0,a=0,c=e.count;o<c;o++,a+=2)B0.fromBufferAttribute(e,o),k0.fromBufferAttribute(i,o),s[a]=a===0?0:s[a-1],s[a+1]=s[a]+B0.distanceTo(k0);let r=new $i(s,2,1);return t.setAttribute("instanceDistanceStart",new Un(r,1,0)),t.setAttribute("instanceDistanceEnd",new Un(r,1,1)),this}raycast(t,e){let i=this.material.worldUnits,s=t.camera;if(s===null&&!i&&console.error('LineSegments2: "Raycaster.camera" needs to be set in order to raycast against LineSegments2 while worldUnits is set to false.'),i===!1&&(this.material.resolution.x===0||this.material.resolution.y===0))return;let r=t.params.Line2!==void 0&&t.params.Line2.threshold||0;ei=t.ray;let o=this.matrixWorld,a=this.geometry,c=this.material;Ls=c.linewidth+r,a.boundingSphere===null&&a.computeBoundingSphere(),eh.copy(a.boundingSphere).applyMatrix4(o);let l;if(i)l=Ls*.5;else{let u=Math.max(s.near,eh.distanceToPoint(ei.origin));l=V0(s,u,c.resolution)}if(eh.radius+=l,ei.intersectsSphere(eh)===!1)return;a.boundingBox===null&&a.computeBoundingBox(),th.copy(a.boundingBox).applyMatrix4(o);let h;if(i)h=Ls*.5;else{let u=Math.max(s.near,th.distanceToPoint(ei.origin));h=V0(s,u,c.resolution)}th.expandByScalar(h),ei.intersectsBox(th)!==!1&&(i?wE(this,e):EE(this,s,e))}onBeforeRender(t){let e=this.material.uniforms;e&&e.resolution&&(t.getViewport(kf),this.material.uniforms.resolution.value.set(kf.z,kf.w))}};var G0={rolling:null,sliding:[1.5,.9],flight:[.28,.55]};function AE(n){let t=[];for(let e=0;e+1<n.length;e++)t.push(...n[e],...n[e+1]);return t}var nh=class{constructor(){this.group=new Xe,this.lines=new Map,this.pixels={width:1,height:1}}#t(t,e,i,s,r,o,a,c){let l=i==="thread",h=this.lines.get(t);h||(h=l?new bi(new ue,new Zn({transparent:!0,depthWrite:!1})):new Fr(new Is,new Or({dashed:G0[i]!==null,transparent:!0,depthWrite:!1})),h.frustumCulled=!1,this.lines.set(t,h),this.group.add(h)),h.geometry.dispose();let u=h.material;if(u.color.set(s),u.opacity=o,h.renderOrder=c?3:2,h.visible=!0,h instanceof Fr){let f=G0[i];h.geometry=new Is().setPositions(e),h.material.linewidth=r,h.material.resolution.set(this.pixels.width,this.pixels.height),f&&(h.material.dashSize=f[0]*a,h.material.gapSize=f[1]*a,h.computeLineDistances())}else h.geometry=new ue,h.geometry.setAttribute("position",new Xt(e,3))}update(t,e){for(let o of this.lines.values())o.visible=!1;let i=jn(t.box)/100,s=t.scene.balls.length>6,r=t.scene.balls.length>60;for(let[o,a]of t.runs){let c=o===t.followed;a.balls.forEach(({pieces:l},h)=>{let u=h===t.ball;if(!u&&(!c||r))return;let f=(u?t.colours.get(o):null)??e(h),d={rolling:[],sliding:[],flight:[],thread:[]};for(let{style:g,points:_}of ks(l,t.span,t.scene.balls[h].radius)){if(d[t.scene.floor?g:"rolling"].push(...AE(_)),g!=="flight"||!t.scene.floor||s)continue;let p=t.scene.balls[h].radius;for(let m of _)m[2]>p*1.001&&m[2]<5*p&&d.thread.push(...m,m[0],m[1],0)}for(let[g,_]of Object.entries(d)){if(!_.length)continue;let p=g==="thread"?.35:u?1:s?.45:.75;this.#t(`${o} ${h} ${g}`,_,g,f,u?c?3.4:2.4:1.4,p,i,c)}})}}resize(t,e){this.pixels={width:t,height:e};for(let i of this.lines.values())i instanceof Fr&&i.material.resolution.set(t,e)}};function Hf(n,t){let e=new ue;return e.setAttribute("position",new Xt(n,3)),e.setIndex(t),e.computeVertexNormals(),e}function TE(n,t,e){let i=[],s=[];for(let r of n)for(let o=0;o+1<r.length;o++){let a=i.length/3;i.push(...r[o],t,...r[o+1],t,...r[o+1],e,...r[o],e),s.push(a,a+1,a+2,a,a+2,a+3)}return Hf(i,s)}function H0(n,t){let e=[];for(let s of t)for(let r of n)for(let o=0;o+1<r.length;o++)e.push(...r[o],s,...r[o+1],s);let i=new ue;return i.setAttribute("position",new Xt(e,3)),i}function CE(n,t,e){let i=Math.max(...t.balls.map(p=>p.radius)),[,s]=Jc(n,t,e),r=n.nose_height??null,o=Math.max(Math.min(s,1.7*i),r===null?0:r+.12*i),a=2.2*i,c=r===null?[[0,0],[0,o],[a,o],[a,0]]:[[.55*i,0],[0,r],[.25*i,o],[a,o],[a,0]],[l,h]=n.center,u=[[-1,-1],[1,-1],[1,1],[-1,1],[-1,-1]].map(([p,m])=>c.map(([y,S])=>[l+p*(n.length/2+y),h+m*(n.width/2+y),S])),f=[],d=[];for(let p=0;p<4;p++)for(let m=0;m+1<c.length;m++){let y=f.length/3;f.push(...u[p][m],...u[p+1][m],...u[p+1][m+1],...u[p][m+1]),d.push(y,y+1,y+2,y,y+2,y+3)}let g=1,_=u.map(p=>[p[g][0],p[g][1]]);return{faces:Hf(f,d),lines:H0([_],[c[g][1]])}}function Gf(n,t,e,i,s){let r=jn(i),o=Math.hypot(t[0],t[1]),a=Ur(i),c=(n[0]-a[0])*t[0]+(n[1]-a[1])*t[1]+(n[2]-a[2])*t[2],l=En(a,rn(t,c));if(o<.05){let w=.62*r,U=l[2],C=-Math.sign(t[2])*.02*r;return new Si(2*w,2*w,Math.abs(C)).translate(a[0],a[1],U+C/2)}let h=Ge([-t[1],t[0],0]),u=va(t,h),f=u[2]<0?rn(u,-1):u,[d,g]=Jc({},e,i),_=w=>En(l,rn(f,(w-l[2])/f[2])),p=.75*r,m=rn(Ge([t[0],t[1],0]),-.05*r),[y,S]=[_(d),_(g)],v=[En(y,rn(h,-p)),En(y,rn(h,p)),En(S,rn(h,p)),En(S,rn(h,-p))],A=v.map(w=>En(w,m)),E=s?[0,1,2,0,2,3,3,2,6,3,6,7,0,4,5,0,5,1,1,5,6,1,6,2,0,3,7,0,7,4]:[0,1,2,0,2,3],x=Hf([...v,...A].flat(),E).toNonIndexed();return x.computeVertexNormals(),x}function RE(n,t,e){let[i,s]=Jc(n,t,e);switch(n.shape){case"table":return[CE(n,t,e)];case"plane":{let r=Ge(n.normal);return[{faces:Gf(n.point,r,t,e,!0),clear:Math.hypot(r[0],r[1])<.05}]}case"strip":{let r=Ge(n.normal),o=En(n.point,rn(r,n.width)),a=Math.hypot(r[0],r[1])<.05;return[{faces:Gf(n.point,r,t,e,!0),clear:a},{faces:Gf(o,rn(r,-1),t,e,!0),clear:a}]}case"box":{let[r,o]=Of(n),a=rn(En(r,o),.5);return[{faces:new Si(...n.size).translate(...a),inside:n.inside}]}case"sphere":return[{faces:new ws(n.radius,48,24).rotateX(Math.PI/2).translate(...n.center),inside:n.inside,lines:new ue}];case"cylinder":{let r=Ge(n.axis),o=as(n.length),a=Math.abs(r[2])>.99,c=Number.isFinite(o)?o:a?s-i:2*jn(e),l=new Gi(n.radius,n.radius,c,64,1,n.inside);l.applyQuaternion(new Ne().setFromUnitVectors(new N(0,1,0),new N(...r)));let h=Number.isFinite(o)||a?0:-c/2,u=Number.isFinite(o)||!a?n.point:[n.point[0],n.point[1],r[2]>0?i:s];return[{faces:l.translate(...En(u,rn(r,h+c/2))),inside:n.inside}]}default:{let r=Qo(n,e);return[{faces:TE(r,i,s),lines:H0(r,[i,s]),clear:!0}]}}}function W0(n,t,e){let i=new Xe,s=new Zn({color:e.edge});for(let r of n.walls)for(let{faces:o,lines:a,inside:c,clear:l}of RE(r,n,t)){let h=!!(l||c),u=new Es({color:e.wall,side:c?De:Sn,transparent:h,opacity:h?.3:1,depthWrite:!h,polygonOffset:!0,polygonOffsetFactor:1,polygonOffsetUnits:1});i.add(new _e(o,u)),i.add(new bi(a??new Ao(o,25),s))}return i}function X0(n){n.traverse(t=>{t.geometry?.dispose();for(let e of[t.material].flat())e?.dispose()})}var $0=26,q0=1.8;function Y0(n){let t=10**Math.floor(Math.log10(n)),e=n/t;return(e>=5?5:e>=2?2:1)*t}function PE(){let n=document.createElement("canvas").getContext("webgl2"),t=n?.getExtension("WEBGL_debug_renderer_info"),e=n&&t?String(n.getParameter(t.UNMASKED_RENDERER_WEBGL)):"";return n?.getExtension("WEBGL_lose_context")?.loseContext(),/swiftshader|llvmpipe|software|basic render/i.test(e)}function Z0(n,t,e){let i=new Xc({antialias:!PE(),alpha:!1,powerPreference:"low-power"}),s=i.domElement;s.tabIndex=0,s.setAttribute("role","img"),n.prepend(s);let r=new xo,o=new je(30,1,.01,100);o.up.set(0,0,1);let a=new Lo("#ffffff",2.3);a.position.set(.5,-1,2.1);let c=new No("#ffffff",1.35);r.add(a,c);let l=null,h=0,u=Zc(q),f=new N,d={groups:[],of:""},g=new Map,_=[],p=new nh,m=NE();r.add(m.group,p.group);let y={width:1,height:1},S=new Uo,v=null,A=[0,0],E=Z=>{let ot=s.getBoundingClientRect();return new Rt(Z.clientX-ot.left,Z.clientY-ot.top)},x=Z=>{let ot=Z.clone().project(o);return new Rt((ot.x+1)/2*y.width,(1-ot.y)/2*y.height)},w=Z=>{if(!l)return null;let ot=l.scene.balls[l.ball].position[2];return S.setFromCamera(new Rt(Z.x/y.width*2-1,1-Z.y/y.height*2),o),Math.abs(S.ray.direction.z)<.03?null:S.ray.intersectPlane(new Ke(new N(0,0,1),-ot),new N)},U=Z=>{if(!l||!m.group.visible)return null;let ot=l.scene.balls[l.ball],z=new N(...ot.position),it=new N(1,0,0).applyQuaternion(o.quaternion).multiplyScalar(ot.radius),F=Math.max(x(z).distanceTo(x(z.clone().add(it))),$0*.7);return x(m.tip).distanceTo(Z)<$0?"velocity":x(z).distanceTo(Z)<F?"ball":null};s.addEventListener("pointerdown",Z=>{if(Z.button!==0||!Z.isPrimary||!l)return;let ot=E(Z),z=U(ot),it=z&&w(ot);if(!z||!it)return;v=z,L.enabled=!1,s.setPointerCapture(Z.pointerId);let F=z==="ball"?l.scene.balls[l.ball].position:m.tip.toArray();A=[F[0]-it.x,F[1]-it.y],t?.start()}),s.addEventListener("pointermove",Z=>{let ot=E(Z);if(!v){Z.buttons===0&&(s.style.cursor=U(ot)?"grab":"");return}let z=w(ot);if(!z||!l)return;s.style.cursor="grabbing";let[it,F]=[z.x+A[0],z.y+A[1]];if(v==="ball")t?.ball(it,F);else{let{position:et,radius:st}=l.scene.balls[l.ball],Mt=Math.hypot(it-et[0],F-et[1]),Wt=Math.max(0,Mt-q0*st)/m.time;t?.velocity(Wt*(it-et[0])/(Mt||1),Wt*(F-et[1])/(Mt||1))}});let C=()=>{v&&(v=null,L.enabled=!0,s.style.cursor="",m.time=l?Dr(l):1,I(),t?.end(),u())};s.addEventListener("pointerup",C),s.addEventListener("pointercancel",C);let L=new jc(o,s);L.zoomSpeed=.8,L.maxPolarAngle=Math.PI*.499,L.addEventListener("change",()=>u());function I(){if(!l)return;let{position:Z,velocity:ot,radius:z}=l.scene.balls[l.ball],it=Math.hypot(ot[0],ot[1]),F=it>0?[ot[0]/it,ot[1]/it]:[1,0];m.place(Z,F,q0*z+it*m.time,z,jn(l.box))}function B(Z,ot){let z=!l||l.box!==Z.box;l=Z,r.background=new zt(ot.background);let it=JSON.stringify([Z.scene.walls,!!Z.scene.floor,Z.box,ot,Z.scene.balls.map(({radius:F})=>F)]);if(it!==d.of){let F=[LE(Z,ot),W0(Z.scene,Z.box,ot)];r.add(...F);for(let et of d.groups)r.remove(et),X0(et);d={groups:F,of:it}}R(Z.span);for(let{mesh:F}of _)r.remove(F.group);_=[];for(let[F,et]of Z.runs){let st=F===Z.followed;et.balls.forEach(({pieces:Mt},Wt)=>{if(!st&&Wt!==Z.ball)return;let yt=Z.colours.get(F)??ot.ink,Nt=Wt===Z.ball,Ht=st?Nr(Z.scene.balls[Wt],Wt):yt,Ct=st?Nt?yt:"#2b2f36":ot.dark?"#15181d":"#ffffff",le={ghost:!st,halo:Nt?yt:null,floor:!!Z.scene.floor,dark:ot.dark},jt=JSON.stringify([F,Wt,Ht,Ct,le]),ve=g.get(jt)??new Yc(Ht,Ct,le);g.set(jt,ve),ve.resize(Z.scene.balls[Wt].radius),r.add(ve.group),_.push({mesh:ve,turns:new Li(Mt),law:F,ball:Wt})})}m.colour(ot.ink),v||(m.time=Dr(Z)),I(),z&&K("free"),W(h)}function R(Z){if(!l)return;let{balls:ot}=l.scene;p.update({...l,span:Z},z=>Nr(ot[z],z))}function W(Z){h=Z,u()}function q(){if(!l)return;let Z=l.runs.get(l.followed),ot=Z?Wn(Z.balls[l.ball].pieces,h).x:null;for(let{mesh:it,turns:F,law:et}of _){let{x:st}=Wn(F.pieces,h),Mt=et===l.followed||!ot?1/0:Math.hypot(st[0]-ot[0],st[1]-ot[1],st[2]-ot[2]);it.place(st,F.at(h),Mt)}m.group.visible=t!==null&&Math.abs(o.getWorldDirection(f).z)>.12,i.render(r,o),H(ot);let z=[new N(...l.scene.balls[l.ball].position),m.tip].map(it=>x(it).toArray().map(Math.round).join());[s.dataset.ball,s.dataset.arrow]=z}function H(Z){if(!l)return;let ot=o.position.distanceTo(L.target),z=y.height/(2*ot*Math.tan(o.fov*Math.PI/360)),it=Y0(110/z),F=`${(it*z).toFixed(1)}px`;e.scale.style.width!==F&&(e.scale.style.width=F,e.scale.textContent=it>=1?`${it} m`:`${Number((it*1e3).toPrecision(1))} mm`);let et=Z&&l.scene.floor?Z[2]-l.scene.balls[l.ball].radius:0;if(e.height.hidden=!(Z&&et>2e-5),Z&&et>2e-5){let st=x(new N(Z[0],Z[1],Z[2]+l.scene.balls[l.ball].radius));e.height.textContent=`${et<.1?`${(et*1e3).toPrecision(2)} mm`:`${et.toPrecision(3)} m`} up`,e.height.style.transform=`translate(${st.x.toFixed(1)}px, ${(st.y-26).toFixed(1)}px) translateX(-50%)`}}function K(Z){if(!l)return;let{low:ot,high:z}=l.box,it=new N(...Ur(l.box)),F=l.scene.walls.find(Ct=>Ct.shape==="plane"&&Math.hypot(Ct.normal[0],Ct.normal[1])>.3),et=l.runs.get(l.followed)?.events.find(Ct=>Ct.kind==="wall"&&Ct.ball===l?.ball),st=F?Ge([F.normal[0],F.normal[1],0]):Z==="along"&&et?IE(et.impulse):[0,-1,0],Mt=new N(st[0],st[1],0),Wt=new N(-st[1],st[0],0),yt=[];for(let Ct of[ot[0],z[0]])for(let le of[ot[1],z[1]])for(let jt of[ot[2],z[2]])yt.push(new N(Ct,le,jt));let Nt=new N;if(Z==="along"){Nt.copy(Wt).multiplyScalar(-1).setZ(.05);let Ct=l.scene.balls[l.ball].radius;et&&l.scene.floor&&(it.set(et.x[0],et.x[1],1.6*Ct).addScaledVector(Mt,3*Ct),yt=[-5,6].flatMap(le=>[-1.4,2].map(jt=>it.clone().addScaledVector(Mt,le*Ct).setZ(it.z+jt*Ct))))}else Z==="side"?Nt.copy(Mt).setZ(.05):Z==="above"?Nt.set(0,-5e-4,1):Nt.copy(Mt).multiplyScalar(F?.8:1).addScaledVector(Wt,F?-.75:.2).setZ(F?.8:1.05);Nt.normalize();let Ht=X(yt,it,Nt);o.near=Math.max(Ht/200,1e-4),o.far=Ht*60,o.updateProjectionMatrix(),L.target.copy(it),o.position.copy(it).addScaledVector(Nt,Ht),L.minDistance=Ht/40,L.maxDistance=Ht*8,L.update(),u()}function X(Z,ot,z){let it=new N().crossVectors(o.up,z).normalize(),F=new N().crossVectors(z,it),et=Math.tan(o.fov*Math.PI/360)*.9;return Math.max(...Z.map(st=>{let Mt=st.clone().sub(ot);return Mt.dot(z)+Math.max(Math.abs(Mt.dot(it))/(et*o.aspect),Math.abs(Mt.dot(F))/et)}))}function Y(){let[Z,ot]=[n.clientWidth,n.clientHeight];!Z||!ot||(i.setPixelRatio(Math.min(devicePixelRatio,2)),i.setSize(Z,ot),Object.assign(y,{width:Z,height:ot}),o.aspect=Z/ot,o.updateProjectionMatrix(),p.resize(s.width,s.height),u())}function rt(){return q(),new Promise((Z,ot)=>s.toBlob(z=>z?Z(z):ot(new Error("The browser gave no picture.")),"image/png"))}return Y(),{update:B,trace:R,draw:W,look:K,resize:Y,picture:rt}}var IE=([n,t])=>Math.abs(n)>Math.abs(t)?[Math.sign(n),0,0]:[0,Math.sign(t)||-1,0];function LE(n,t){let e=new Xe;if(!n.scene.floor)return e;let i=jn(n.box),[s,r]=Ur(n.box),o=1.6*i,a=new _e(new Ms(2*o,2*o),new On({color:t.floor,polygonOffset:!0,polygonOffsetFactor:2,polygonOffsetUnits:2}));a.position.set(s,r,0),e.add(a);let c=Y0(i/6),l=[];for(let u=Math.ceil((s-o)/c);u*c<=s+o;u++)l.push(u*c,r-o,0,u*c,r+o,0);for(let u=Math.ceil((r-o)/c);u*c<=r+o;u++)l.push(s-o,u*c,0,s+o,u*c,0);let h=new ue;return h.setAttribute("position",new Xt(l,3)),e.add(new bi(h,new Zn({color:t.grid}))),e}function NE(){let n=new On({color:"#000000"}),t=new _e(new Gi(1,1,1,12).rotateX(Math.PI/2).translate(0,0,.5),n),e=new _e(new Eo(1,1,20).rotateX(Math.PI/2).translate(0,0,-.5),n),i=new _e(new Ss(.9,1,48),new On({color:"#000000",transparent:!0,opacity:.5,depthWrite:!1})),s=new Xe;s.add(t,e,i);let r=new N,o=new N(0,0,1);return{group:s,tip:r,time:1,colour(a){n.color.set(a),i.material.color.set(a)},place(a,c,l,h,u){let f=Math.max(.07*h,.0022*u),d=new Ne().setFromUnitVectors(o,new N(c[0],c[1],0));r.set(a[0]+c[0]*l,a[1]+c[1]*l,a[2]);let g=Math.min(6*f,.6*l);t.position.set(...a),t.quaternion.copy(d),t.scale.set(f,f,Math.max(l-g,1e-9)),e.position.copy(r),e.quaternion.copy(d),e.scale.set(2.4*f,2.4*f,g),i.position.set(a[0],a[1],a[2]-h*.99),i.scale.setScalar(h)}}}var J0=0;function ni(n,t=!1){let e=Zt("message");e.textContent=n,e.hidden=!n,e.className=t?"good":"bad",clearTimeout(J0),t&&(J0=window.setTimeout(()=>e.hidden=!0,6e3))}function DE(n,t){return t?`#${[1,3,5].map(i=>parseInt(n.slice(i,i+2),16)).map(i=>Math.round(i+(255-i)*.28).toString(16).padStart(2,"0")).join("")}`:n}function UE(){let n=getComputedStyle(document.documentElement),t=e=>n.getPropertyValue(`--${e}`).trim();return{background:t("sky"),floor:t("felt"),grid:t("grid"),wall:t("wall"),edge:t("edge"),ink:t("ink"),soft:t("soft"),dark:document.documentElement.dataset.theme==="dark"}}var K0=n=>JSON.parse(Zt(n).textContent??"null");async function OE(){if(performance.mark("script"),document.documentElement.dataset.theme=matchMedia("(prefers-color-scheme: dark)").matches?"dark":"light",typeof WebAssembly!="object")throw new Error("This browser has no WebAssembly, in which carom's engine is: any browser since 2018 has it.");let n=K0("page-data"),t=Uint8Array.from(atob((Zt("engine-module").textContent??"").trim()),f=>f.charCodeAt(0)),e=K0("engine-layout"),{recorded:i,presets:s}=n,r=await(i?Od(t,e,s[0].scene,i):Ud(t,e)),o=r,[a,c]=[r.report.bind(r),r.run.bind(r)],l={run:a,pieces:c,version:r.version};Object.assign(window,{carom:l}),i&&(document.documentElement.dataset.recorded="true");let{store:h,at:u}=FE(n,o);Object.assign(l,{scene:()=>structuredClone(h.state.scene),at:u})}function FE(n,t){let e=new URLSearchParams(location.hash.replace(/^#/,"")).get("preset"),i=Math.max(0,n.presets.findIndex(({name:F})=>F===e)),s=n.presets[i],r=[Ni,...n.cards.map(({name:F})=>F)],o=F=>n.recorded?n.cards:pp(n.cards,F),a=F=>o(F.scene).map(({name:et})=>et).filter(et=>F.laws.includes(et)),c=null;try{n.recorded||(c=zh(location.hash,t,r))}catch(F){ni(li(F))}let l=c?.scene??Gs(t,s.scene),h=c?.laws??a(s),u=Hs(t,l,h.length?h:[l.run.law]).fault;u!==null&&c&&(ni(`The scene of this link cannot be shown: ${u}`),c=null,l=Gs(t,s.scene));let f=new Xa({scene:l,laws:c?.laws??a(s),followed:"",ball:0,wall:-1,t:c?.t??s.time??0,playing:!1,span:c?null:s.span??null,speed:s.slow??1,rebounds:n.rebounds,reboundsFrom:n.reboundsFrom,cards:o(l)}),{state:d}=f,g=F=>[F,d.cards[0]?.name===Ni?Ni:void 0,d.scene.run.law].find(et=>et&&d.laws.includes(et))??d.laws[0]??"";d.followed=g(c?.followed);let _=Hs(t,d.scene,d.laws),p=Bh(d.scene,_.runs.values(),d.span),m=ta(d.scene,_.runs,d.followed,p),y=kh(d.scene,_.runs.get(d.followed)),S=()=>new Map(d.cards.map(({name:F,colour:et})=>[F,DE(et,document.documentElement.dataset.theme==="dark")])),v=Zt("stage"),A=n.recorded?null:{start:()=>f.remember(),ball:(F,et)=>q(yn(d.scene,d.ball,{position:[F,et,d.scene.balls[d.ball].position[2]]})),velocity:(F,et)=>q(yn(d.scene,d.ball,{velocity:[F,et,d.scene.balls[d.ball].velocity[2]]})),end:()=>{}},E,x=!!document.createElement("canvas").getContext("webgl2");x?E=Z0(v,A,{scale:Zt("scale"),height:Zt("height")}):(E=N0(v,A),Zt("scale").hidden=!0,ni("This browser has no WebGL 2: the scene is drawn from above and from the side."));let w=v.querySelector("canvas"),U=v.querySelector(".views");for(let{name:F,label:et}of x?R0:[])U.append(Jt("button",{type:"button","data-view":F,click:()=>{m=ta(d.scene,_.runs,d.followed,p),Y(new Set(["scene"])),E.look(F)}},et));let C=W(),L=hp(Zt("controls"),f,q,ni),I=Am(Zt("angles")),B=Rm(f,()=>({...p,events:y})),R=Tm(Zt("course"),B.seek);_p(f,E,()=>_.runs.get(d.followed),ni);function W(){return Zt("laws").replaceChildren(Jt("h2",{},"Laws")),{cards:d.cards,panel:up(Zt("laws"),f)}}function q(F){let et=Hs(t,F,d.laws.length?d.laws:[F.run.law]);if(et.fault!==null){ni(et.fault),L.update();return}ni(""),f.change({scene:F,span:null},"scene")}let H=new Set,K=!1;f.listen(F=>{(F.has("scene")||F.has("laws"))&&(d.cards=o(d.scene),d.laws=d.cards.map(({name:et})=>et).filter(et=>d.laws.includes(et)),d.followed=g(d.followed),_=Hs(t,d.scene,d.laws),p=Bh(d.scene,_.runs.values(),d.span),y=kh(d.scene,_.runs.get(d.followed)),d.t=Math.max(p.from,Math.min(d.t,p.until))),H=new Set([...H,...F]),K||requestAnimationFrame(()=>Y(H)),K=!0});function X(){let F=Vd(_.runs.get(d.followed),p);return F===1/0?p:{from:Math.max(p.from,d.t-F),until:d.t}}function Y(F){K=!1,H=new Set;let et=S();if(F.has("scene")||F.has("laws")){E.update({scene:d.scene,ball:d.ball,followed:d.followed,runs:_.runs,colours:et,span:X(),box:m},UE()),Zt("key").hidden=!d.scene.floor,w.setAttribute("aria-label",`The scene: ${d.scene.balls.length} ball${d.scene.balls.length>1?"s":""} under ${d.laws.join(", ")||"no law"}. Drag the ball or its arrow, or use the sliders.`);let{verdicts:st,none:Mt}=Fh(t,d.scene);C.cards.length!==d.cards.length&&Object.assign(C,W()),C.panel.update(st,et,_.notes,Mt),L.update(),rt(st,et),Z(et)}else F.has("data")?rt(Fh(t,d.scene).verdicts,et):X()!==p&&E.trace(X());E.draw(d.t),R.place(d.t),B.update()}function rt(F,et){let st=d.cards.filter(({name:yt})=>d.laws.includes(yt)),Mt=dp(t,d.scene,st.map(({name:yt})=>yt)),Wt=mp(d.scene,d.ball);I.update(st.map(({name:yt,dashes:Nt})=>({name:yt,colour:et.get(yt)??"#888",dashes:Nt,width:yt===d.followed?2.4:1.6,points:Mt.get(yt)??[]})),d.rebounds,Wt,st.flatMap(({name:yt})=>{let Nt=F.get(yt)?.angle;return typeof Nt=="number"?[{colour:et.get(yt)??"#888",y:Nt}]:[]})),Zt("measured").textContent=d.rebounds.length?`${d.rebounds.length} from ${d.reboundsFrom}`:"drop a CSV table anywhere on the page"}function Z(F){let et=[],st=[];for(let{name:Mt,dashes:Wt}of d.cards){let yt=_.runs.get(Mt);if(!yt)continue;let Nt={name:Mt,colour:F.get(Mt)??"#888",dashes:Wt,width:Mt===d.followed?2.2:1.5},Ht=Gd(yt,d.ball,p,60),Ct=ba(d.scene,yt,0),le=d.scene.floor?d.scene.balls[d.ball].radius:0;Ct>0&&et.push({...Nt,points:Ht.map(jt=>[jt,ba(d.scene,yt,jt)/Ct])}),st.push({...Nt,points:Ht.map(jt=>[jt,(Wn(yt.balls[d.ball].pieces,jt).x[2]-le)*1e3])})}R.update(et,st,p)}let ot=Zt("preset");ot.append(...n.presets.map(({title:F},et)=>Jt("option",{value:String(et)},F))),ot.value=String(i);let z=F=>Zt("about").textContent=F;z(c?"":s.about),ot.onchange=()=>{let F=n.presets[Number(ot.value)];f.remember(),ni(""),z(F.about),Object.assign(d,{ball:0,wall:-1,t:F.time??0,span:F.span??null,speed:F.slow??1,playing:!1}),f.change({scene:Gs(t,F.scene),laws:a(F),followed:F.scene.run.law},"scene","laws","time"),m=ta(d.scene,_.runs,d.followed,p),Y(new Set(["scene"])),E.look(F.view??"free")},Zt("undo").onclick=()=>f.undo(),Zt("redo").onclick=()=>f.redo(),Zt("theme").onclick=()=>{let F=document.documentElement;F.dataset.theme=F.dataset.theme==="dark"?"light":"dark",Y(new Set(["scene"]))},addEventListener("keydown",F=>{!(F.ctrlKey||F.metaKey)||F.key.toLowerCase()!=="z"||(F.preventDefault(),F.shiftKey?f.redo():f.undo())}),addEventListener("hashchange",()=>{try{let F=n.recorded?null:zh(location.hash,t,r);if(!F)return;let et=Hs(t,F.scene,F.laws.length?F.laws:[F.scene.run.law]).fault;if(et!==null)throw new Error(et);f.remember(),f.change({...F,ball:0,wall:-1,span:null,playing:!1},"scene","laws","time"),m=ta(d.scene,_.runs,d.followed,p),Y(new Set(["scene"]))}catch(F){ni(li(F))}}),new ResizeObserver(()=>{E.resize(),Y(new Set(["scene"]))}).observe(v),Y(new Set(["scene"])),E.look(c?"free":s.view??"free"),performance.mark("ready"),document.documentElement.dataset.ready="true";function it(F){let et=_.runs.get(d.followed);return et?{energy:ba(d.scene,et,F),balls:et.balls.map(({pieces:st})=>({...Wn(st,F),q:new Li(st).at(F)}))}:null}return{store:f,at:it}}OE().catch(n=>{ni(li(n)),document.documentElement.dataset.ready="failed"});})();
